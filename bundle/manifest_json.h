// SPDX-License-Identifier: Apache-2.0
// These functions convert the part of a manifest that is written as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "bundle/manifest.h"
#include "bundle/view.h"

namespace vitrail {

using Json = nlohmann::ordered_json;

Json manifest_to_json(const Manifest& manifest);
Json camera_to_json(const Camera& camera);
Json film_to_json(const FilmSettings& film);
Json view_to_json(const View& view);
// Writes the shutter, and how the camera and each object move.
Json motions_to_json(const Manifest& manifest);

// They throw nlohmann's exceptions for keys that are missing and values of a wrong type, and Error for
// unknown words.
Manifest manifest_from_json(const Json& json);
View view_from_json(const Json& json);

}  // namespace vitrail
