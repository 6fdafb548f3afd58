// SPDX-License-Identifier: Apache-2.0
// Developing turns a film into a picture.
#pragma once

#include "film/film.h"
#include "film/film_rows.h"
#include "film/film_survey.h"
#include "film/neighbours.h"
#include "scene/records/image.h"

namespace vitrail {

// A PictureOrigin tells where a picture comes from. An empty field or 0 is unknown.
struct PictureOrigin {
  std::string software, scene, scene_hash, seeds, film_hash;
  std::string glazing;    // in which state it was set; empty: as the scene says
  std::string sampling;   // options that say how; empty: as usual
  std::string denoiser;   // with its version; empty: the noise is the render's
  std::string groups;     // weights of groups of lights; empty: all 1
  int least_samples = 0;  // of a pixel
  // They have 16 numbers each, row by row, of matrices that take columns; they are empty where unknown.
  std::vector<float> world_to_camera, world_to_ndc;
};

// A PictureChannel is a channel beside the colours.
struct PictureChannel {
  std::string name;
  bool is_id = false;
  std::vector<float> values;       // of pixels; empty where it is an id
  std::vector<std::uint32_t> ids;  // 0: none
};

// PictureMattes are masks among the channels (cryptomatte.h).
struct PictureMattes {
  std::string layer;     // what their channels begin with: "CryptoObject"
  std::string manifest;  // the names of their ids (matte_manifest); "" where names are not known
};

// A Picture is an image and what is known of how it came to be. Zero stands for unknown.
struct Picture {
  Image rgb;       // linear sRGB
  Image variance;  // of the mean luminance of each pixel, one channel; 0 × 0 where unknown
  Image spectrum;  // mean radiance of each bin, one channel a bin; 0 × 0 where unknown
  SpectralBins bins;
  std::vector<PictureChannel> layers;  // of an .exr; its ids and mattes are not read
  PixelRect window;
  int full_width = 0, full_height = 0;
  int samples_per_pixel = 0;
  double render_time_s = 0;
  double shared_error = 0;  // Film's
  Neighbours neighbours;
  PictureOrigin origin;  // of an .exr
  std::vector<PictureMattes> mattes;
};

// Returns the means of the film in linear sRGB, not clamped, and the variances of their luminance.
// `samples_per_pixel` is the most that a pixel has. Throws Error if the film is saturated.
Picture develop(const Film& film);

// Develops a film that stays in its file, of which some rows at a time are in memory.
Picture develop(const FilmRows& film);

// Develops some rows of a film, of which `whole` is known.
Picture develop(const Film& rows, const FilmSurvey& whole);

// Develops the colours, their place and their alpha alone.
Picture develop_colors(const Film& film);

// Develops the same of a film that stays in its file.
Picture develop_colors(const FilmRows& film);

// Throws Error where deposits were too large, and says what to do. `file` is the film's.
void require_unsaturated(const Refused& refused, const std::filesystem::path& file);

// Throws Error where nothing was rendered yet.
void require_samples(std::uint64_t samples, const std::filesystem::path& file);

// Makes a picture brighter by `ev` stops: values and spectra times 2^ev, variances times 4^ev.
void expose(Picture& picture, double ev);

}  // namespace vitrail
