// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace vitrail {

// It holds a value that is kept elsewhere, for members that few records have: a std::variant is as large as
// its largest alternative, in each of a million records. It is copied and compared as the value is. One that
// was never set is T{}, and takes no memory but its own 8 bytes.
template <class T>
class Boxed {
 public:
  Boxed() = default;
  // The value is copied or moved into a box of its own.
  template <class U>
  // NOLINTNEXTLINE(bugprone-forwarding-reference-overload): `requires` leaves Boxed out
  requires std::convertible_to<U&&, T> &&(!std::same_as<std::remove_cvref_t<U>, Boxed>)Boxed(U&& value)
      : value_(std::make_unique<T>(std::forward<U>(value))) {}
  Boxed(const Boxed& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Boxed(Boxed&&) noexcept = default;
  Boxed& operator=(const Boxed& other) { return *this = Boxed(other); }
  Boxed& operator=(Boxed&&) noexcept = default;
  ~Boxed() = default;

  // Returns the value, which is there: T{} where none was set. To change one that was never set takes memory.
  const T& operator*() const { return value_ ? *value_ : unset(); }
  T& operator*() {
    if (!value_) value_ = std::make_unique<T>();
    return *value_;
  }
  const T* operator->() const { return &**this; }
  T* operator->() { return &**this; }
  operator const T&() const { return **this; }
  bool operator==(const Boxed& other) const { return **this == *other; }

 private:
  static const T& unset() {
    static const T value{};
    return value;
  }
  std::unique_ptr<T> value_;
};

}  // namespace vitrail
