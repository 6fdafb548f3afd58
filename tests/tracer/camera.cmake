# SPDX-License-Identifier: Apache-2.0
vitrail_test(camera LABEL unit SOURCES camera_test.cpp pixel_filter_test.cpp LIBRARIES vitrail::test_support)
