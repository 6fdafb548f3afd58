// SPDX-License-Identifier: Apache-2.0
#include "glazing/thin_film.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

using Complex = std::complex<double>;

// Of the library's only what IEEE 754 rounds: a sheet has the same bits on every machine.
Complex square_root(Complex z) {
  const double root = std::sqrt((std::abs(z.real()) + std::sqrt(std::norm(z))) / 2);
  if (root == 0) return 0;
  const double other = z.imag() / (2 * root);
  return z.real() >= 0 ? Complex(root, other) : Complex(std::abs(other), std::copysign(root, z.imag()));
}

// n·cos θ in a medium, on the branch where a wave decays forwards.
Complex n_cosine(Complex n, double sine) {
  const Complex root = square_root(n * n - sine * sine);
  return root.imag() > 0 ? -root : root;
}

// Admittance of the tangential fields, in units of that of free space.
Complex admittance(Complex n, double sine, bool parallel) {
  const Complex nc = n_cosine(n, sine);
  return parallel ? n * n / nc : nc;
}

struct OneWay {
  double r = 0, t = 0;
};

OneWay one_way(Complex n_first, std::span<const FilmAt> films, bool reversed, Complex n_last, double sine,
               double nm, bool parallel) {
  const Complex first = admittance(n_first, sine, parallel), last = admittance(n_last, sine, parallel);
  // (B, C) = ∏ M · (1, η_last), from the last film to the first.
  Complex b = 1, c = last;
  double scale = 1;  // of |B|², taken out so that thick metals do not overflow
  for (std::size_t i = 0; i < films.size(); ++i) {
    const FilmAt& film = films[reversed ? i : films.size() - 1 - i];
    const Complex eta = admittance(film.index, sine, parallel);
    const Complex delta = 2 * pi * film.thickness_nm / nm * n_cosine(film.index, sine);
    // cos δ and i·sin δ, both times |e^(−iδ)| = √faded.
    const double faded = portable_exp(2 * delta.imag());
    const double even = (1 + faded) / 2, odd = (1 - faded) / 2;
    const Complex cosine(even * portable_cos(delta.real()), odd * portable_sin(delta.real()));
    const Complex sine_i(odd * portable_cos(delta.real()), even * portable_sin(delta.real()));
    const Complex b_next = cosine * b + sine_i / eta * c;
    c = eta * sine_i * b + cosine * c;
    b = b_next;
    scale *= faded;
  }
  const Complex sum = first * b + c;
  return {std::norm((first * b - c) / sum), 4 * first.real() * last.real() * scale / std::norm(sum)};
}

// An element of the chain: seen from before and from behind.
InterfaceValues joined(const InterfaceValues& a, const InterfaceValues& b) {
  const double series = 1 / (1 - a.r_back * b.r);
  return {a.r + a.t * b.r * a.t_back * series, a.t * b.t * series,
          b.r_back + b.t_back * a.r_back * b.t * series, b.t_back * a.t_back * series};
}

Complex index_of(const IndexRows& rows, double nm) {
  const IndexRow row = index_at(rows, nm);
  return {row.n, -row.k};
}

}  // namespace

InterfaceValues film_stack(double n_first, std::span<const FilmAt> films, Complex n_last, double sine,
                           double nm, bool parallel) {
  const OneWay there = one_way(n_first, films, false, n_last, sine, nm, parallel);
  const OneWay back = one_way(n_last.real(), films, true, n_first, sine, nm, parallel);
  return {there.r, there.t, back.r, back.t};
}

PaneValues stack_values(const StackPane& stack, double nm, double cosine, bool parallel) {
  if (!(cosine > 1e-6)) return {0, 1, 1};
  const double sine = std::sqrt(1 - std::min(1.0, cosine) * std::min(1.0, cosine));
  InterfaceValues all{0, 1, 0, 1};
  double n_before = 1;
  for (std::size_t i = 0; i <= stack.slabs.size(); ++i) {
    std::vector<FilmAt> films;
    for (const FilmLayer& film : stack.films[i])
      films.push_back({index_of(film.index, nm), film.thickness_nm});
    // The absorption of a slab is counted on its way through; at its faces only its real index acts.
    const bool last = i == stack.slabs.size();
    const Complex n = last ? Complex(1) : index_of(stack.slabs[i].index, nm);
    all = joined(all, film_stack(n_before, films, n.real(), sine, nm, parallel));
    if (last) break;
    const double n_cos = n_cosine(n.real(), sine).real();
    const double inner = n_cos / n.real();
    const double passage =
        inner > 0 ? portable_exp(4 * pi * n.imag() * stack.slabs[i].thickness_mm * 1e6 / (nm * inner)) : 0;
    all = joined(all, {0, passage, 0, passage});
    n_before = n.real();
  }
  return {all.t, all.r, all.r_back};
}

}  // namespace vitrail
