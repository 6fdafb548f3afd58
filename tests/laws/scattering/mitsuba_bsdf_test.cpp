// SPDX-License-Identifier: Apache-2.0
// Surfaces against Mitsuba's, value by value, at directions that our own sampling and a uniform one choose.
#include <deque>
#include <random>

#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/table_cases.h"
#include "tests/support/paths.h"
#include "tracer/bsdf/adaptive.h"
#include "tracer/bsdf/conductor.h"
#include "tracer/bsdf/dielectric.h"
#include "tracer/bsdf/diffuse.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/hair.h"
#include "tracer/bsdf/plastic.h"

namespace vitrail::mitsuba_bsdf_test {
namespace {

using laws::Subject;
using laws::subject;

struct Pair {
  Vector3d out, in;
};

class MitsubaBsdf : public testing::Test {
 protected:
  void SetUp() override {
    if (mitsuba_python().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  }

  // Half of the pairs lie in the lobes.
  static std::vector<Pair> pairs(const Subject& s) {
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    const auto on_sphere = [&](bool both_sides) {
      const double z = both_sides ? 2.0 * static_cast<double>(uniform()) - 1 : static_cast<double>(uniform());
      const double phi = 6.283185307 * static_cast<double>(uniform()), r = std::sqrt(1 - z * z);
      return Vector3d{r * std::cos(phi), r * std::sin(phi), z};
    };
    std::vector<Pair> result;
    while (result.size() < 400) {
      const Vector3d out = on_sphere(s.two_sides);
      if (std::abs(out.z) < 0.02) continue;  // single precision loses the finest lobes there
      const float u_lobe = uniform(), u = uniform(), v = uniform();
      if (const auto drawn = s.sample(out, u_lobe, {u, v});
          drawn && !drawn->specular && std::abs(drawn->in.z) > 0.02)
        result.push_back({out, drawn->in});
      result.push_back({out, on_sphere(true)});
    }
    return result;
  }

  void ask(const Json& bsdf, const Subject& s, std::vector<Pair> asked, const Json& wavelengths = {}) {
    Json numbers = Json::array();
    for (const Pair& p : asked) numbers.push_back({p.out.x, p.out.y, p.out.z, p.in.x, p.in.y, p.in.z});
    request_.push_back({{"bsdf", bsdf}, {"pairs", numbers}});
    if (!wavelengths.is_null()) request_.back()["wavelengths"] = wavelengths;
    questions_.push_back({bsdf.dump(), s, std::move(asked)});
  }
  void ask(const Json& bsdf, const Subject& s) { ask(bsdf, s, pairs(s)); }

  struct Question {
    std::string name;
    Subject subject;
    std::vector<Pair> asked;
  };

  // What Mitsuba says to all that was asked.
  Json answers() {
    std::ofstream(folder_ / "request.json") << request_;
    const std::string command =
        mitsuba_python() + " " + test::project_file("tests/laws/mitsuba_bsdf_oracle.py ") +
        (folder_ / "request.json").string() + " " + (folder_ / "answer.json").string();
    if (std::system(command.c_str()) != 0) throw std::runtime_error("the oracle failed: " + command);
    return Json::parse(std::ifstream(folder_ / "answer.json"));
  }

  // Each value and pdf as much as it differs, relative to the greater of the two.
  void expect_same(double value_tolerance, double pdf_tolerance) {
    const Json all = answers();
    for (std::size_t q = 0; q < questions_.size(); ++q) {
      const auto& [text, s, asked] = questions_[q];
      double worst = 0, worst_pdf = 0, sum = 0, sum_theirs = 0;
      for (std::size_t i = 0; i < asked.size(); ++i) {
        const BsdfValue ours = s.eval(asked[i].out, asked[i].in);
        const double value = static_cast<double>(ours.value[0]), theirs = all[q]["values"][i].get<double>();
        const double pdf = all[q]["pdfs"][i].get<double>();
        worst = std::max(worst, std::abs(value - theirs) / (std::max(value, theirs) + 1e-3));
        worst_pdf = std::max(worst_pdf, std::abs(ours.pdf - pdf) / (std::max(ours.pdf, pdf) + 1e-3));
        sum += value;
        sum_theirs += theirs;
      }
      EXPECT_LT(worst, value_tolerance) << text;
      EXPECT_LT(worst_pdf, pdf_tolerance) << text;
      EXPECT_GT(sum, 0) << text;
      std::printf("  worst value %.2g, pdf %.2g, total %.2g: %s\n", worst, worst_pdf, sum / sum_theirs - 1,
                  text.c_str());
    }
  }

  // Of deltas: what the first and the last random number lead to.
  void expect_same_deltas() {
    const Json all = answers();
    for (std::size_t q = 0; q < questions_.size(); ++q) {
      const auto& [text, s, asked] = questions_[q];
      for (std::size_t i = 0; i < asked.size(); ++i)
        for (std::size_t end : {0u, 1u}) {
          const auto ours = s.sample(asked[i].out, end == 0 ? 0.0f : 0.9999999f, {0.5f, 0.5f});
          ASSERT_TRUE(ours && ours->specular);
          const Json& theirs = all[q]["specular"][i][end];
          EXPECT_NEAR(ours->in.z, theirs[0].get<double>(), 1e-3) << text << asked[i].out.z;
          EXPECT_NEAR(ours->weight[0], theirs[1].get<double>(), 2e-3) << text << asked[i].out.z;
        }
    }
  }

  Json request_ = Json::array();
  std::vector<Question> questions_;
  TemporaryFolder folder_;
};

const auto both = {Roughness::Distribution::ggx, Roughness::Distribution::beckmann};
std::string name(Roughness::Distribution d) { return d == Roughness::Distribution::ggx ? "ggx" : "beckmann"; }

TEST_F(MitsubaBsdf, Diffuse) {
  ask({{"type", "diffuse"}, {"reflectance", 0.4}}, subject(LambertBsdf{filled(0.4f)}));
  expect_same(1e-5, 1e-5);
}

TEST_F(MitsubaBsdf, RoughConductor) {
  for (const auto d : both)
    for (const auto& [u, v] : {std::pair{0.01, 0.01}, {0.1, 0.1}, {0.5, 0.5}, {1.0, 1.0}, {0.05, 0.3}}) {
      const Json bsdf{{"type", "roughconductor"},   {"eta", 0.2},   {"k", 3.9},
                      {"distribution", name(d)},    {"alpha_u", u}, {"alpha_v", v},
                      {"specular_reflectance", 0.8}};
      ask(bsdf, subject(ConductorBsdf{make_microfacets(u, v, d, Masking::separable), filled(0.2f),
                                      filled(3.9f), filled(0.8f)}));
    }
  expect_same(0.01, 0.01);
}

TEST_F(MitsubaBsdf, RoughDielectric) {
  for (const auto d : both)
    for (const auto& [u, v] : {std::pair{0.02, 0.02}, {0.1, 0.1}, {0.5, 0.5}, {1.0, 1.0}, {0.05, 0.3}})
      for (double eta : {1.5, 1 / 1.33}) {
        const Json bsdf{{"type", "roughdielectric"}, {"int_ior", eta}, {"ext_ior", 1.0},
                        {"distribution", name(d)},   {"alpha_u", u},   {"alpha_v", v}};
        ask(bsdf, subject(DielectricBsdf{eta, make_microfacets(u, v, d, Masking::separable)}, true, eta));
      }
  expect_same(0.01, 0.01);
}

TEST_F(MitsubaBsdf, Plastic) {
  for (bool nonlinear : {false, true})
    for (float rho : {0.2f, 0.9f}) {
      const double eta = 1.49 / 1.000277;
      const Json bsdf{{"type", "plastic"},
                      {"diffuse_reflectance", rho},
                      {"specular_reflectance", 0.7},
                      {"nonlinear", nonlinear}};
      ask(bsdf, subject(PlasticBsdf{filled(rho), filled(0.7f), eta, fresnel_diffuse(1 / eta), nonlinear}));
    }
  expect_same(2e-3, 1e-5);
}

TEST_F(MitsubaBsdf, RoughPlastic) {
  std::deque<RoughPlasticTables> tables;
  for (const auto d : both)
    for (double alpha : {0.02, 0.1, 0.3, 0.8})
      for (bool nonlinear : {false, true}) {
        const double eta = 1.49 / 1.000277;
        tables.push_back(
            make_rough_plastic_tables(eta, make_microfacets(alpha, alpha, d, Masking::separable)));
        const Json bsdf{{"type", "roughplastic"},
                        {"diffuse_reflectance", 0.6},
                        {"specular_reflectance", 0.7},
                        {"nonlinear", nonlinear},
                        {"alpha", alpha},
                        {"distribution", name(d)}};
        ask(bsdf, subject(RoughPlasticBsdf{filled(0.6f), filled(0.7f), eta,
                                           make_microfacets(alpha, alpha, d, Masking::separable),
                                           &tables.back(), nonlinear}));
      }
  expect_same(0.01, 0.02);
}

TEST_F(MitsubaBsdf, Measured) {
  std::deque<std::pair<AdaptiveTable, AdaptiveWarps>> tables;
  for (const auto& [u, v] : {std::pair{0.3, 0.3}, {0.15, 0.4}}) {
    const AdaptiveTable made =
        laws::adaptive_table({.facets = make_microfacets(u, v), .low = 0.2, .high = 0.8});
    tables.emplace_back(made, warps_of(made));
    const std::string file = (folder_ / fmt::format("{}.bsdf", v)).string();
    laws::write(made, file);
    for (const float nm : {380.0f, 487.0f, 640.0f}) {
      const std::array<float, 4> wavelengths{nm, 500, 600, 700};
      const Subject s = subject(AdaptiveBsdf{&tables.back().first, &tables.back().second, {wavelengths, {}}});
      ask({{"type", "measured"}, {"filename", file}}, s, pairs(s), wavelengths);
    }
  }
  expect_same(2e-3, 2e-3);
}

// Mitsuba's fibre runs along y of the local frame. Its ln I₀(x) lacks 1/(16x) where x > 12: 0.5 % there;
// where lobes are so wide that x stays below, the two agree to 7e-5.
TEST_F(MitsubaBsdf, Hair) {
  const auto along_y = [](Vector3d v) { return Vector3d{v.y, -v.x, v.z}; };
  for (const auto& [beta_m, beta_n] : {std::pair{0.1, 0.3}, {0.3, 0.3}, {0.6, 0.1}, {1.0, 1.0}})
    for (double alpha : {0.0, 2.0, 8.0})
      for (float sigma_a : {0.0f, 0.3f, 3.0f}) {
        const Json bsdf{{"type", "hair"},
                        {"sigma_a", sigma_a},
                        {"longitudinal_roughness", beta_m},
                        {"azimuthal_roughness", beta_n},
                        {"scale_tilt", alpha},
                        {"ext_ior", 1.0},
                        {"int_ior", 1.55}};
        const HairBsdf ours = make_hair(filled(sigma_a), filled(1), 1.55, beta_m, beta_n, alpha);
        Subject s;
        s.eval = [=](Vector3d out, Vector3d in) { return eval(ours, along_y(out), along_y(in)); };
        s.sample = [=](Vector3d out, float u_lobe, Point2f u) {
          auto drawn = sample(ours, along_y(out), u_lobe, u);
          if (drawn) drawn->in = {-drawn->in.y, drawn->in.x, drawn->in.z};
          return drawn;
        };
        ask(bsdf, s);
      }
  expect_same(0.01, 0.01);
}

TEST_F(MitsubaBsdf, Deltas) {
  const auto ask_everywhere = [&](const Json& bsdf, const Subject& s) {
    std::vector<Pair> asked;
    for (Vector3d above : laws::incidences())
      for (double side : {1.0, -1.0})
        if ((side > 0 || s.two_sides) && above.z > 1e-3)
          asked.push_back({{above.x, above.y, above.z * side}, {0, 0, 1}});
    ask(bsdf, s, asked);
  };
  const double eta = 1.5046 / 1.000277;
  ask_everywhere({{"type", "dielectric"}}, subject(DielectricBsdf{.eta = eta}, true, eta));
  ask_everywhere({{"type", "thindielectric"}},
                 subject(ThinDielectricBsdf{filled(static_cast<float>(eta))}, true));
  ask_everywhere({{"type", "conductor"}, {"eta", 0.2}, {"k", 3.9}},
                 subject(ConductorBsdf{.eta = filled(0.2f), .k = filled(3.9f)}));
  ask_everywhere({{"type", "conductor"}, {"material", "none"}}, subject(ConductorBsdf{.perfect = true}));
  expect_same_deltas();
}

}  // namespace
}  // namespace vitrail::mitsuba_bsdf_test
