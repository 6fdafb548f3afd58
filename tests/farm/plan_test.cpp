// SPDX-License-Identifier: Apache-2.0
// What a job makes of its options before the first ray: edits of the scene, choices of sampling, rounds.
#include <gmock/gmock.h>

#include <numeric>

#include "farm/plan/rounds.h"
#include "farm/plan/sample_choices.h"
#include "farm/plan/scene_edits.h"
#include "scene/system/diagnostics.h"

namespace vitrail::plan_test {
namespace {

Light named(LightModel model, const char* name) {
  Light light;
  light.model = std::move(model);
  light.name = name;
  return light;
}

// A lamp whose spectrum has the scale 2, a sky, the sun.
Manifest lit() {
  Manifest m;
  PointLight lamp;
  lamp.intensity = RgbIlluminantSpectrum{{}, 2};
  m.lights = {named(lamp, "lamp"), named(SkyLight{}, "sky"), named(DistantLight{}, "sun")};
  return m;
}

Manifest edited(Manifest m, std::initializer_list<const char*> texts) {
  std::vector<SceneEdit> edits;
  for (const char* text : texts) edits.push_back(parse_scene_edit(text));
  edit_scene(edits, m);
  return m;
}

template <class L>
const L& light(const Manifest& m, std::size_t i) {
  return std::get<L>(m.lights.at(i).model);
}

TEST(SceneEdits, ScaleLights) {
  const Manifest m = edited(lit(), {"lamp.scale=3", "sky.scale=0.5"});
  EXPECT_EQ(std::get<RgbIlluminantSpectrum>(light<PointLight>(m, 0).intensity).scale, 6);
  EXPECT_EQ(light<SkyLight>(m, 1).sky_scale, 0.5f);
  EXPECT_EQ(light<SkyLight>(m, 1).sun_scale, 0.5f);
  EXPECT_NE(m.scene_hash, lit().scene_hash);
}

TEST(SceneEdits, TurnTheSun) {
  const Manifest m = edited(lit(), {"sky.sun=3:0:4", "sun.sun=0:0:2", "sky.turbidity=10", "sky.ground=0.2"});
  const Vector3d& to_sun = light<SkyLight>(m, 1).to_sun;
  EXPECT_DOUBLE_EQ(to_sun.x, 0.6);
  EXPECT_DOUBLE_EQ(to_sun.z, 0.8);
  EXPECT_DOUBLE_EQ(light<DistantLight>(m, 2).direction.z, -1);
  EXPECT_EQ(light<SkyLight>(m, 1).turbidity, 10) << "the most that there is";
  EXPECT_EQ(light<SkyLight>(m, 1).ground, 0.2f);
}

TEST(SceneEdits, AnotherSkyStandsWhereTheFirstStood) {
  Manifest m = lit();
  auto& sky = std::get<SkyLight>(m.lights[1].model);
  sky.light_to_world = rotate(90, {1, 0, 0});
  const Transform stands = sky.light_to_world;
  const Manifest other = edited(m, {"sky.sky=48.85,2.35,2026-06-21T12:00+02:00,turbidity=4"});
  EXPECT_EQ(light<SkyLight>(other, 1).turbidity, 4);
  EXPECT_EQ(*light<SkyLight>(other, 1).light_to_world, stands);
}

TEST(SceneEdits, OfTheSkyAreThoseOfTheOneThatThereIs) {
  const char* const words = "48.85,2.35,2026-06-21T12:00+02:00,turbidity=4";
  const SceneEdit edit = parse_sky_edit(words);
  Manifest m = lit();
  edit_scene({&edit, 1}, m);
  const Manifest set = edited(lit(), {"sky-2.sky=48.85,2.35,2026-06-21T12:00+02:00,turbidity=4"});
  EXPECT_EQ(m.lights, set.lights);
  EXPECT_EQ(m.scene_hash, set.scene_hash);
  Manifest several = lit(), none = lit();
  several.lights.push_back(named(SkyLight{}, "other"));
  none.lights.erase(none.lights.begin() + 1);
  EXPECT_THROW(edit_scene({&edit, 1}, several), UsageError);
  EXPECT_THROW(edit_scene({&edit, 1}, none), UsageError);
}

TEST(SceneEdits, RefuseWhatTheyCannotBe) {
  for (const char* text :
       {"sky.ground=1.1", "sky.turbidity=10.5", "sky.turbidity=x", "sky.turbidity=1:2", "lamp.scale=1e999",
        "lamp.scale=2x", "sky.sun=0:0:0", "sky.sky=48.85,2.35,2026-06-21T12:00+02:00,up=y",
        "sky.sky=48.85,2.35,2026-06-21T12:00+02:00,north=x", "sky=1"})
    EXPECT_THROW(parse_scene_edit(text), UsageError) << text;
  EXPECT_THROW(edited(lit(), {"lamp.turbidity=3"}), UsageError);
  EXPECT_THROW(edited(lit(), {"lamp.sun=0:0:1"}), UsageError);
  EXPECT_THROW(edited(lit(), {"lump.scale=2"}), UsageError);
}

TEST(SampleChoices, AreSaidAsOptionsWhereTheyAreNotTheUsual) {
  EXPECT_EQ(words_of(SampleChoices{}), "");
  SampleChoices c;
  c.sampling.one_sequence = true;
  EXPECT_EQ(words_of(c), "--one-sequence");
  c.textures = TextureChoice::nearest;
  EXPECT_EQ(words_of(c), "--one-sequence --texture-filter nearest");
  c.textures = TextureChoice::unfiltered;
  c.sampling = {};
  EXPECT_EQ(words_of(c), "--texture-filter none");
  c.textures = {};
  c.sampling.roulette = Roulette::early;
  EXPECT_EQ(words_of(c), "--roulette early");
  c.sampling.roulette = Roulette::never;
  c.sampling.splat = true;
  EXPECT_EQ(words_of(c), "--splat --roulette never");
}

// ---- Rounds

constexpr std::uint32_t side = 16;

// An even film, noisier to the right.
Film noisy_film(std::uint32_t samples) {
  FilmSettings settings;
  settings.width = settings.height = side;
  settings.crop = {0, side, 0, side};
  Film film(settings, {1, 0, 5});
  for (std::uint32_t i = 0; i < film.pixels(); ++i)
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      const double v = 1 + (sample % 2 == 0 ? 1 : -1) * 0.5 * (i % side) / side;
      film.count_sample(i, sample);
      film.deposit(i, sample, {v, v, v});
    }
  return film;
}

TEST(Rounds, AdaptiveOnesGiveWhatIsLeftToAllPixels) {
  Goal goal;
  goal.in_rounds = goal.adaptive = true;
  goal.samples = 12;
  const std::optional<NextRound> next = next_round(noisy_film(4), goal);
  ASSERT_TRUE(next);
  ASSERT_EQ(next->more.size(), side * side);
  const double given = std::accumulate(next->more.begin(), next->more.end(), 0.0);
  EXPECT_NEAR(given / (side * side), 8, 0.5);
}

TEST(Rounds, EndWhereNobodyAskedForANumberOfSamples) {
  RenderOptions o;
  o.picture.target_error = TargetError{0.01};
  EXPECT_TRUE(goal_of(o, {}).open_ended);
  EXPECT_EQ(goal_of(o, {}).samples, static_cast<std::uint32_t>(most_samples_unasked));
  o.picture.samples_per_pixel = 64;
  EXPECT_FALSE(goal_of(o, {}).open_ended);
  EXPECT_EQ(goal_of(o, {}).samples, 64u);
}

TEST(Rounds, TheTargetIsMetByTheUpperBound) {
  Goal goal;
  goal.in_rounds = true;
  goal.samples = 1 << 20;
  const Film film = noisy_film(1024);
  const double reached = reached_error(film, TargetError{1}).upper;
  goal.target = TargetError{1.01 * reached};
  EXPECT_FALSE(next_round(film, goal)) << "it is reached";
  goal.target = TargetError{0.1 * reached};
  EXPECT_TRUE(next_round(film, goal));
}

}  // namespace
}  // namespace vitrail::plan_test
