// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/round_tree.h"

#include <algorithm>
#include <bit>

namespace vitrail {

namespace {

constexpr int tag_of_rounds = 2;
constexpr std::size_t report_values = sizeof(RankReport) / sizeof(std::int64_t);
using SumValues = std::array<std::int64_t, round_values>;
using ReportValues = std::array<std::int64_t, report_values>;

constexpr std::size_t values_of(int ranks) {
  return round_values + report_values * static_cast<std::size_t>(ranks);
}

MPI_Request receive(std::vector<std::int64_t>& into, int from) {
  MPI_Request request;
  MPI_Irecv(into.data(), static_cast<int>(into.size()), MPI_INT64_T, from, tag_of_rounds, MPI_COMM_WORLD,
            &request);
  return request;
}

MPI_Request send(const std::vector<std::int64_t>& values, int to) {
  MPI_Request request;
  MPI_Isend(values.data(), static_cast<int>(values.size()), MPI_INT64_T, to, tag_of_rounds, MPI_COMM_WORLD,
            &request);
  return request;
}

bool all_done(std::span<MPI_Request> requests) {
  return std::ranges::all_of(requests, [](MPI_Request& request) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
}

}  // namespace

TreePlace place_in_tree(int rank, int ranks) {
  TreePlace place{.end = ranks};
  for (int at = 0;;) {
    const int below = place.end - at - 1, children = std::min(TreePlace::most_children, below);
    std::vector<int> first;
    for (int i = 0; i < children; ++i)
      first.push_back(at + 1 + static_cast<int>(std::int64_t{below} * i / children));
    if (at == rank) {
      place.children = std::move(first);
      return place;
    }
    const auto after = std::ranges::upper_bound(first, rank);
    place.parent = at;
    if (after != first.end()) place.end = *after;
    at = *(after - 1);
  }
}

RoundTree::RoundTree(int rank, int ranks) : rank_(rank), place_(place_in_tree(rank, ranks)) {
  all_.resize(values_of(ranks));
  part_.resize(values_of(place_.end - rank));
  for (std::size_t i = 0; i < place_.children.size(); ++i) {
    const int end = i + 1 < place_.children.size() ? place_.children[i + 1] : place_.end;
    parts_.emplace_back(values_of(end - place_.children[i]));
  }
}

void RoundTree::start(const RoundSums& mine, const RankReport& report) {
  std::ranges::copy(std::bit_cast<SumValues>(mine), part_.begin());
  std::ranges::copy(std::bit_cast<ReportValues>(report), part_.begin() + round_values);
  if (place_.parent >= 0) with_parent_ = {receive(all_, place_.parent), MPI_REQUEST_NULL};
  for (std::size_t i = 0; i < parts_.size(); ++i)
    with_children_.push_back(receive(parts_[i], place_.children[i]));
  step_ = Step::gathers;
}

std::optional<Round> RoundTree::finish() {
  if (step_ == Step::gathers && all_done(with_children_)) {
    add_children();
    if (place_.parent >= 0)
      with_parent_[1] = send(part_, place_.parent);
    else
      all_ = part_;
    step_ = Step::hears;
  }
  if (step_ == Step::hears && all_done(with_parent_)) {
    for (const int child : place_.children) with_children_.push_back(send(all_, child));
    step_ = Step::tells;
  }
  if (step_ != Step::tells || !all_done(with_children_)) return std::nullopt;
  with_children_.clear();
  return told();
}

void RoundTree::add_children() {
  with_children_.clear();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (std::size_t n = 0; n < round_values; ++n) part_[n] += parts_[i][n];
    std::copy(parts_[i].begin() + round_values, parts_[i].end(),
              part_.begin() + static_cast<std::ptrdiff_t>(values_of(place_.children[i] - rank_)));
  }
}

Round RoundTree::told() const {
  SumValues sums;
  std::copy_n(all_.begin(), round_values, sums.begin());
  Round round{std::bit_cast<RoundSums>(sums), {}};
  for (auto at = all_.begin() + round_values; at != all_.end(); at += report_values) {
    ReportValues report;
    std::copy_n(at, report_values, report.begin());
    round.ranks.push_back(std::bit_cast<RankReport>(report));
  }
  return round;
}

}  // namespace vitrail
