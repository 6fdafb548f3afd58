# SPDX-License-Identifier: Apache-2.0
vitrail_test(texture_file LABEL unit SOURCES texture_file_test.cpp LIBRARIES vitrail::bundle)
