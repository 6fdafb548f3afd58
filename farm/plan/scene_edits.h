// SPDX-License-Identifier: Apache-2.0
// `vitrail render --set` changes these parts of a bundle besides the states of its glass: the picture is that
// of a bundle which is made of the scene edited in that way.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// It is NAME.PROPERTY=VALUE. A light is named by its name (bundle/light_names.h), else by the name of a
// material that shines, else by kind and number (area-1). Its properties are:
// - scale, at least 0: times its light;
// - sun=x:y:z, towards the sun in the world, of a sky or a distant light;
// - turbidity, 1 … 10, and ground, the share that it reflects, of a sky;
// - sky=WORDS, as of --sky (scene/daylight/given_sky.h) without up and north: another place, time or weather.
// A material is named as the scene's file names it. Its properties are:
// - color=r:g:b, linear sRGB in [0, 1]: its diffuse reflectance or base colour;
// - roughness: the α of its microfacets, or of Disney's material its roughness.
struct SceneEdit {
  std::string text, name,
      property;                 // name "": of --sky, the one sky that there is; of --lamps off, all lamps
  std::vector<double> values;   // one or three
  std::optional<SkyLight> sky;  // of the property `sky`
};

// Returns whether the property of a text is one of these.
bool is_scene_edit(const std::string& text);
// Throws UsageError where the text is no such edit.
SceneEdit parse_scene_edit(const std::string& text);
// Returns the edit that the words of --sky make: NAME.sky=WORDS of the one sky that the bundle has. Throws
// UsageError.
SceneEdit parse_sky_edit(const std::string& words);
// Returns the edit that --lamps off makes: all that shines in the scene has a scale of 0, and media have no
// light. Light from infinitely far stays.
SceneEdit lamps_off();
// Returns words that name the lamps, as "area-1, Desk are off".
std::string words_of_lamps(const Manifest& manifest);

// Applies the edits in the order in which they are given. A blank of a name may be given as "_". Throws
// UsageError where nothing has that name or property, with the names that there are. It also throws it where
// the bundle would have to be made anew, or has no sky or several for --sky. The manifest's scene_hash
// becomes another one: that of `--set sky-1.sky=WORDS` for --sky.
void edit_scene(std::span<const SceneEdit> edits, Manifest& manifest);

}  // namespace vitrail
