// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/number_words.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "importers/povray/read/whole.h"

namespace vitrail::pov {

namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr NumberFunction functions[] = {
    {Word::abs_, [](double x) { return std::abs(x); }},
    {Word::acos_, [](double x) { return std::acos(std::clamp(x, -1.0, 1.0)); }},
    {Word::acosh_, [](double x) { return std::acosh(x); }},
    {Word::asin_, [](double x) { return std::asin(std::clamp(x, -1.0, 1.0)); }},
    {Word::asinh_, [](double x) { return std::asinh(x); }},
    {Word::atan_, [](double x) { return std::atan(x); }},
    {Word::atanh_, [](double x) { return std::atanh(x); }},
    {Word::ceil_, [](double x) { return std::ceil(x); }},
    {Word::cos_, [](double x) { return std::cos(x); }},
    {Word::cosh_, [](double x) { return std::cosh(x); }},
    {Word::degrees_, [](double x) { return x / degree; }},
    {Word::exp_, [](double x) { return std::exp(x); }},
    {Word::floor_, [](double x) { return std::floor(x); }},
    {Word::int_, [](double x) { return std::trunc(x); }},
    {Word::ln_, [](double x) { return std::log(x); }},
    {Word::log_, [](double x) { return std::log10(x); }},
    {Word::radians_, [](double x) { return x * degree; }},
    {Word::sgn_, [](double x) { return x > 0   ? 1.0
                                       : x < 0 ? -1.0
                                               : 0.0; }},
    {Word::sin_, [](double x) { return std::sin(x); }},
    {Word::sinh_, [](double x) { return std::sinh(x); }},
    {Word::sqr_, [](double x) { return x * x; }},
    {Word::sqrt_, [](double x) { return x < 0 ? 0 : std::sqrt(x); }},
    {Word::tan_, [](double x) { return std::tan(x); }},
    {Word::tanh_, [](double x) { return std::tanh(x); }},
    {Word::trunc_, [](double x) { return std::trunc(x); }},
    {Word::atan2_, nullptr, [](double y, double x) { return std::atan2(y, x); }},
    {Word::div_, nullptr, [](double a, double b) { return b == 0 ? 0 : std::trunc(a / b); }},
    {Word::mod_, nullptr, [](double a, double b) { return b == 0 ? 0 : std::fmod(a, b); }},
    {Word::pow_, nullptr, [](double a, double b) { return std::pow(a, b); }},
    {Word::max_, nullptr, [](double a, double b) { return std::max(a, b); }, true},
    {Word::min_, nullptr, [](double a, double b) { return std::min(a, b); }, true},
    {Word::bitwise_and_, nullptr, [](double a, double b) { return static_cast<double>(whole(a) & whole(b)); },
     true},
    {Word::bitwise_or_, nullptr, [](double a, double b) { return static_cast<double>(whole(a) | whole(b)); },
     true},
    {Word::bitwise_xor_, nullptr, [](double a, double b) { return static_cast<double>(whole(a) ^ whole(b)); },
     true},
};

}  // namespace

const NumberFunction* number_function(Word word) {
  const auto* found = std::find_if(std::begin(functions), std::end(functions),
                                   [&](const NumberFunction& f) { return f.word == word; });
  return found == std::end(functions) ? nullptr : found;
}

bool names_text(Word word) {
  switch (word) {
    case Word::chr_:
    case Word::concat_:
    case Word::datetime_:
    case Word::str_:
    case Word::strlwr_:
    case Word::strupr_:
    case Word::substr_:
    case Word::vstr_:
      return true;
    default:
      return false;
  }
}

bool names_number(Word word) {
  switch (word) {
    case Word::pi_:
    case Word::tau_:
    case Word::true_:
    case Word::false_:
    case Word::yes_:
    case Word::no_:
    case Word::on_:
    case Word::off_:
    case Word::x_:
    case Word::y_:
    case Word::z_:
    case Word::u_:
    case Word::v_:
    case Word::t_:
    case Word::clock_:
    case Word::clock_delta_:
    case Word::clock_on_:
    case Word::version_:
    case Word::image_width_:
    case Word::image_height_:
    case Word::frame_number_:
    case Word::initial_frame_:
    case Word::final_frame_:
    case Word::initial_clock_:
    case Word::final_clock_:
    case Word::now_:
    case Word::select_:
    case Word::rand_:
    case Word::seed_:
    case Word::vaxis_rotate_:
    case Word::vcross_:
    case Word::vdot_:
    case Word::vlength_:
    case Word::vnormalize_:
    case Word::vrotate_:
    case Word::vturbulence_:
    case Word::asc_:
    case Word::strlen_:
    case Word::strcmp_:
    case Word::val_:
    case Word::defined_:
    case Word::dimensions_:
    case Word::dimension_size_:
    case Word::file_exists_:
    case Word::inside_:
    case Word::trace_:
    case Word::min_extent_:
    case Word::max_extent_:
      return true;
    default:
      return number_function(word) != nullptr;
  }
}

}  // namespace vitrail::pov
