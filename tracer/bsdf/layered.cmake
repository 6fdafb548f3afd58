# SPDX-License-Identifier: Apache-2.0
target_sources(vitrail_bsdf PRIVATE
  coating.cpp layered.cpp layered_base.cpp measured.cpp principled.cpp principled_lobes.cpp principled_thin.cpp)
