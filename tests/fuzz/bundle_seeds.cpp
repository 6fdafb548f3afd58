// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bundle_seeds.h"

#include "bundle/ray_profile.h"
#include "film/film_progress.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

void add_bundle_seeds(const std::function<void(const char*, const std::string&)>& add) {
  const TemporaryDirectory directory;
  write_sample_bundle(directory.path());
  add("manifest", read_text(directory / "manifest.json"));
  add("domain", read_text(domain_path(directory.path(), 0)));
  SampleBundle whole = whole_bundle();
  const TemporaryDirectory with_all;
  write(whole, with_all.path());
  for (std::uint32_t i = 0; i < whole.domains.size(); ++i)
    add("domain", read_text(domain_path(with_all.path(), i)));
  add("manifest", read_text(with_all / "manifest.json"));
  const std::vector<std::uint64_t> rays(whole.domains.size(), 10);
  const std::vector<double> seconds(whole.domains.size(), 0.5);
  write_ray_profile(directory / "profile.json", {whole.manifest, rays, seconds, {{0, 1, 5}}, {}});
  add("profile", read_text(directory / "profile.json"));
  FilmSettings settings;
  settings.width = settings.height = 2;
  settings.crop = {0, 2, 0, 2};
  FilmKey clamped;
  clamped.clamp = 1;
  for (const FilmKey& key : {FilmKey{}, clamped}) {
    write_film(directory / "a.film", Film(settings, key), FilmProgress{4, 1, {0}});
    add("film", read_text(directory / "a.film"));
  }
}

}  // namespace vitrail::test
