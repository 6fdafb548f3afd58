// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <fstream>
#include <iterator>

#include "film/develop.h"
#include "film/film_progress.h"
#include "film/png_file.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "scene/system/diagnostics.h"
#include "scene/system/temporary_folder.h"

namespace nb = nanobind;

namespace vitrail::python {

namespace {

// A film, and the picture that it gives.
struct DevelopedFilm {
  explicit DevelopedFilm(const std::filesystem::path& file) : film(read_film(file, &progress)) {
    require_samples(film.samples(), file);
    picture = develop(film);
  }
  FilmProgress progress;
  Film film;
  Picture picture;
};

// None where the film does not keep it.
nb::object as_array(const DevelopedFilm& self, const Image& image) {
  const auto height = static_cast<std::size_t>(image.height), width = static_cast<std::size_t>(image.width),
             channels = static_cast<std::size_t>(image.channels);
  if (image.values.empty()) return nb::none();
  return channels == 1 ? nb::cast(view(image.values.data(), {height, width}, nb::find(self)))
                       : nb::cast(view(image.values.data(), {height, width, channels}, nb::find(self)));
}

nb::dict layers_of(const DevelopedFilm& self) {
  nb::dict layers;
  const auto height = static_cast<std::size_t>(self.film.height()),
             width = static_cast<std::size_t>(self.film.width());
  for (const PictureChannel& channel : self.picture.layers)
    layers[channel.name.c_str()] =
        channel.is_id ? nb::cast(view(channel.ids.data(), {height, width}, nb::find(self)))
                      : nb::cast(view(channel.values.data(), {height, width}, nb::find(self)));
  return layers;
}

// write_png needs a name.
nb::bytes as_png(const DevelopedFilm& self) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.file("film.png");
  write_png(file, self.picture);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return nb::bytes(bytes.data(), bytes.size());
}

Array<std::uint32_t> counts_of(const DevelopedFilm& self) {
  return view(self.film.counts().data(),
              {std::size_t{sample_groups}, static_cast<std::size_t>(self.film.height()),
               static_cast<std::size_t>(self.film.width())},
              nb::find(self));
}

}  // namespace

void add_films(nb::module_& module) {
  nb::class_<DevelopedFilm>(module, "Film",
                            "What render keeps: the sums of all samples. Arrays share its memory.")
      .def(nb::init<const std::filesystem::path&>(), nb::arg("file"))
      .def_prop_ro(
          "width", [](const DevelopedFilm& f) { return f.film.width(); }, "pixels of the crop")
      .def_prop_ro(
          "height", [](const DevelopedFilm& f) { return f.film.height(); }, "pixels of the crop")
      .def_prop_ro(
          "samples", [](const DevelopedFilm& f) { return f.film.samples(); }, "of all pixels")
      .def_prop_ro("seed", [](const DevelopedFilm& f) { return f.film.key().seed; })
      .def_prop_ro(
          "hash", [](const DevelopedFilm& f) { return fmt::format("{:016x}", f.film.hash()); },
          "as `render` prints it")
      .def_prop_ro(
          "complete", [](const DevelopedFilm& f) { return f.progress.complete(); },
          "whether all samples that were asked for are there")
      .def_prop_ro(
          "render_time", [](const DevelopedFilm& f) { return f.progress.render_time_s; }, "seconds")
      .def_prop_ro(
          "rgb", [](const DevelopedFilm& f) { return as_array(f, f.picture.rgb); },
          "float32, height × width × 3: linear sRGB, not clamped")
      .def_prop_ro(
          "variance", [](const DevelopedFilm& f) { return as_array(f, f.picture.variance); },
          "float32, height × width: of each pixel's mean luminance; None where unknown")
      .def_prop_ro(
          "spectrum", [](const DevelopedFilm& f) { return as_array(f, f.picture.spectrum); },
          "float32, height × width × bins, W·m⁻²·sr⁻¹·nm⁻¹; None without --spectral")
      .def_prop_ro("layers", layers_of,
                   "by channel: height × width, float32, or uint32 of ids, where 0 is none")
      .def_prop_ro("counts", counts_of, "uint32, groups × height × width: samples of each pixel")
      .def("_repr_png_", as_png);
}

}  // namespace vitrail::python
