# SPDX-License-Identifier: Apache-2.0
vitrail_test(textures LABEL unit SOURCES baked_image_test.cpp LIBRARIES vitrail::textures)
