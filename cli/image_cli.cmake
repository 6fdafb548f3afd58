# SPDX-License-Identifier: Apache-2.0
# The programs that work on films and images.
