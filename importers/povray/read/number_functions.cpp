// SPDX-License-Identifier: Apache-2.0
// What reserved words give numbers and vectors: constants, functions, questions.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/number_words.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/transforms.h"
#include "importers/povray/read/whole.h"
#include "scene/models/pattern_noise.h"

namespace vitrail::pov {

namespace {

Vector3d first_three(const Numbers& n) { return {n.v[0], n.v[1], n.v[2]}; }
Numbers numbers_of(Vector3d v) { return Numbers::vector(v.x, v.y, v.z); }
Numbers numbers_of(Point3d p) { return Numbers::vector(p.x, p.y, p.z); }

// The streams of rand(), as povray itself shows its states: x ← 1812433253·x + 12345 (mod 2³²), divided by
// 2³² − 1; a stream begins with its seed.
double random_number(std::uint32_t& state) {
  state = state * 1812433253u + 12345u;
  return state / 4294967295.0;
}

}  // namespace

std::optional<Numbers> Reader::constant_of(Word word) {
  switch (word) {
    case Word::pi_:
      return Numbers(std::numbers::pi);
    case Word::tau_:
      return Numbers(2 * std::numbers::pi);
    case Word::true_:
    case Word::yes_:
    case Word::on_:
      return Numbers(1);
    case Word::false_:
    case Word::no_:
    case Word::off_:
    case Word::clock_on_:
    case Word::now_:
    case Word::clock_delta_:
      return Numbers(0);
    case Word::clock_:
      return Numbers(clock);
    // Of an animation the first frame is read. POV-Ray's stills have 0, and refuse many animations.
    case Word::frame_number_:
    case Word::initial_frame_:
    case Word::final_frame_:
    case Word::final_clock_:
      return Numbers(1);
    case Word::initial_clock_:
      return Numbers(0);
    case Word::x_:
      return Numbers::vector(1, 0, 0);
    case Word::y_:
      return Numbers::vector(0, 1, 0);
    case Word::z_:
      return Numbers::vector(0, 0, 1);
    case Word::u_: {
      Numbers n;
      n.terms = 2, n.v[0] = 1;
      return n;
    }
    case Word::v_: {
      Numbers n;
      n.terms = 2, n.v[1] = 1;
      return n;
    }
    case Word::t_: {
      Numbers n;
      n.terms = 4, n.v[3] = 1;
      return n;
    }
    case Word::version_:
      return Numbers(version > 0 ? version : 3.7);
    case Word::image_width_:
      return Numbers(image_width);
    case Word::image_height_:
      return Numbers(image_height);
    default:
      return std::nullopt;
  }
}

double Reader::argument(bool first) { return vector_argument(first).v[0]; }

Numbers Reader::vector_argument(bool first) {
  if (!first) expect(',', "between arguments");
  const bool comparing = comparing_;
  comparing_ = true;
  const Numbers value = conditional();
  comparing_ = comparing;
  return value;
}

std::optional<Numbers> Reader::function_of(const Token& word) {
  const Word name = word.symbol->word;
  const NumberFunction* const known = number_function(name);
  const bool of_vectors = name >= Word::vaxis_rotate_ && name <= Word::vturbulence_;
  if (!known && !of_vectors && name != Word::select_) return std::nullopt;
  expect('(', "behind the name of a function");
  std::optional<Numbers> result;
  if (known) {
    double value = argument(true);
    if (known->one) {
      value = known->one(value);
    } else {
      do {
        value = known->two(value, argument());
      } while (known->folds && at(','));
    }
    result = Numbers(value);
  } else if (name == Word::select_) {
    const double chooses = argument(true);
    const Numbers negative = vector_argument(), second = vector_argument();
    const Numbers third = at(',') ? vector_argument() : second;
    result = chooses < 0 ? negative : chooses == 0 ? second : third;
  } else {
    const Vector3d a = first_three(vector_argument(true).promoted(3));
    const auto second = [&] { return first_three(vector_argument().promoted(3)); };
    if (name == Word::vlength_) result = Numbers(length(a));
    if (name == Word::vnormalize_) result = numbers_of(length(a) > 0 ? a * (1 / length(a)) : a);
    if (name == Word::vcross_) result = numbers_of(cross(a, second()));
    if (name == Word::vdot_) result = Numbers(dot(a, second()));
    if (name == Word::vrotate_) {
      const Vector3d degrees = second();
      result = numbers_of(transform_vector(rotation(degrees), a));
    }
    if (name == Word::vaxis_rotate_) {
      const Vector3d axis = second();
      const double degrees = argument();
      result = numbers_of(transform_vector(rotate(degrees * std::numbers::pi / 180, axis), a));
    }
    if (name == Word::vturbulence_) {
      const double omega = argument(), octaves = argument();
      const Vector3d p = first_three(vector_argument().promoted(3));
      const auto of_four_bytes = [](double x) { return static_cast<double>(static_cast<float>(x)); };
      result = numbers_of(vector_turbulence(
          Point3d{} + p, {whole(octaves, 1, 10), of_four_bytes(a.x), of_four_bytes(omega)}));
    }
  }
  if (!result) return result;
  expect(')', "behind the arguments of a function");
  return result;
}

std::optional<Numbers> Reader::query_of(const Token& word) {
  const Word name = word.symbol->word;
  if (!names_number(name)) return std::nullopt;
  expect('(', "behind the name of a function");
  if (name == Word::defined_) return Numbers(defined_value());
  std::optional<Numbers> result;
  switch (name) {
    case Word::seed_:
      random_.push_back(static_cast<std::uint32_t>(whole(argument(true))));
      result = Numbers(static_cast<double>(random_.size() - 1));
      break;
    case Word::rand_: {
      const double stream = argument(true);
      if (!(stream >= 0 && stream < static_cast<double>(random_.size())))
        fail("rand() takes what seed() gives", word.place);
      result = Numbers(random_number(random_[static_cast<std::size_t>(stream)]));
      break;
    }
    case Word::asc_: {
      const std::string t = text("a text");
      result = Numbers(t.empty() ? 0 : static_cast<unsigned char>(t.front()));
      break;
    }
    case Word::strlen_:
      result = Numbers(static_cast<double>(text("a text").size()));
      break;
    case Word::strcmp_: {
      const std::string a = text("a text");
      expect(',', "between texts");
      const int order = a.compare(text("a text"));
      result = Numbers(order < 0 ? -1 : order > 0 ? 1 : 0);
      break;
    }
    case Word::val_: {
      const std::string t = text("a text");
      double value = 0;
      const auto begin = t.find_first_not_of(" \t");
      if (begin == std::string::npos ||
          fast_float::from_chars(t.data() + begin, t.data() + t.size(), value).ec != std::errc{})
        value = 0;
      result = Numbers(value);
      break;
    }
    case Word::file_exists_: {
      const std::string file = text("the name of a file");
      result = Numbers(written_files_.contains(file) || find(search_, file) ? 1 : 0);
      break;
    }
    case Word::dimensions_:
    case Word::dimension_size_: {
      const Token token = next();
      if (token.kind != TokenKind::word || token.symbol->word != Word::none) unexpected(token, "an array");
      const Value held = postfixed(token);
      const auto* const array = std::get_if<std::shared_ptr<Array>>(&held);
      if (!array)
        fail(fmt::format("'{}' is {}, not an array", token.symbol->name, kind_of(held)), token.place);
      const std::shared_ptr<Array> kept = *array;
      if (name == Word::dimensions_) {
        result = Numbers(static_cast<double>(kept->sizes.size()));
      } else {
        const double dimension = argument();
        if (!(dimension >= 1 && dimension <= static_cast<double>(kept->sizes.size())))
          fail("the array has no such dimension", word.place);
        result = Numbers(static_cast<double>(kept->sizes[static_cast<std::size_t>(dimension) - 1]));
      }
      break;
    }
    case Word::min_extent_:
    case Word::max_extent_: {
      const auto object = identifier<Shared<Object>>();
      if (!object) unexpected(next(), "the name of an object");
      Bounds3d box = extents_of(**object);
      if (box.empty()) box.lower = box.upper = {};  // a text of blanks
      result = numbers_of(name == Word::min_extent_ ? box.lower : box.upper);
      break;
    }
    case Word::inside_:
    case Word::trace_: {
      const auto object = identifier<Shared<Object>>();
      if (!object) unexpected(next(), "the name of an object");
      result = name == Word::inside_ ? inside_of(**object) : traced(**object);
      break;
    }
    default:
      unexpected(word, "a number");
  }
  expect(')', "behind the arguments of a function");
  return result;
}

}  // namespace vitrail::pov
