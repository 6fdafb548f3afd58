# SPDX-License-Identifier: Apache-2.0
vitrail_test(importers_povray_oracle LABEL conformance SOURCES povray_oracle_test.cpp
  LIBRARIES vitrail::povray_exporter)
