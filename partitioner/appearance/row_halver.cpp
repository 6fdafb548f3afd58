// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/row_halver.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// The part [begin, end) of `count` numbers that number i of max(1, count/2) is the mean of.
struct Part {
  double begin, end, length;
  Part(int i, int count) {
    const int half = std::max(1, count / 2);
    length = static_cast<double>(count) / half;
    begin = i * length;
    end = i + 1 == half ? count : (i + 1) * length;
  }
  int first() const { return static_cast<int>(begin); }
  int after() const { return static_cast<int>(std::ceil(end)); }
  double share(int k) const { return std::min(k + 1.0, end) - std::max<double>(k, begin); }
};

}  // namespace

RowHalver::RowHalver(int width, int height, int channels)
    : width_(width), height_(height), channels_(channels) {}

void RowHalver::add(std::span<const float> row, const std::function<void(std::span<const float>)>& emit) {
  const int half = std::max(1, width_ / 2);
  const auto channels = static_cast<std::size_t>(channels_);
  std::vector<float>& narrow = kept_.emplace_back(static_cast<std::size_t>(half) * channels);
  for (int i = 0; i < half && width_ % 2 == 0; ++i) {
    const float* const pair = &row[2 * static_cast<std::size_t>(i) * channels];
    for (std::size_t c = 0; c < channels; ++c)
      narrow[static_cast<std::size_t>(i) * channels + c] =
          static_cast<float>((static_cast<double>(pair[c]) + static_cast<double>(pair[c + channels])) / 2);
  }
  for (int i = 0; i < half && width_ % 2 != 0; ++i) {
    const Part part(i, width_);
    for (std::size_t c = 0; c < channels; ++c) {
      double sum = 0;
      for (int k = part.first(); k < part.after(); ++k)
        sum += static_cast<double>(row[static_cast<std::size_t>(k) * channels + c]) * part.share(k);
      narrow[static_cast<std::size_t>(i) * channels + c] = static_cast<float>(sum / part.length);
    }
  }
  ++taken_;
  const int rows = std::max(1, height_ / 2);
  std::vector<float> out(narrow.size());
  for (; emitted_ < rows; ++emitted_) {
    const Part part(emitted_, height_);
    if (part.after() > taken_) break;
    const auto kept = [&](int k) { return kept_[static_cast<std::size_t>(k - first_)].data(); };
    if (height_ % 2 == 0) {
      const float *const upper = kept(part.first()), *const lower = kept(part.first() + 1);
      for (std::size_t x = 0; x < out.size(); ++x)
        out[x] = static_cast<float>((static_cast<double>(upper[x]) + static_cast<double>(lower[x])) / 2);
    }
    for (std::size_t x = 0; x < out.size() && height_ % 2 != 0; ++x) {
      double sum = 0;
      for (int k = part.first(); k < part.after(); ++k)
        sum += static_cast<double>(kept_[static_cast<std::size_t>(k - first_)][x]) * part.share(k);
      out[x] = static_cast<float>(sum / part.length);
    }
    emit(out);
    const int next = emitted_ + 1 < rows ? Part(emitted_ + 1, height_).first() : height_;
    for (; first_ < std::min(next, taken_); ++first_) kept_.pop_front();
  }
}

}  // namespace vitrail
