# SPDX-License-Identifier: Apache-2.0
# The programs that work on films and images.
vitrail_program(develop SOURCES develop.cpp LIBRARIES vitrail::cli vitrail::image)
vitrail_program(compare SOURCES compare.cpp LIBRARIES vitrail::cli vitrail::compare vitrail::image)
