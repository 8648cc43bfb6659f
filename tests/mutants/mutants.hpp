// Inserted into sources by scripts/mutate: every place that a mutant may change asks whether its number is alive, so
// that all mutants are built at once. The environment selects one, COASTMESH_MUTANT=NUMBER; none if it is not set.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>

namespace mutants {

// Numbers asked for. Written at exit to the file COASTMESH_MUTANTS_ASKED if that is set, as in the run without a
// mutant: a mutant that no test asks for survives; a meaningless one, such as "one more" for something not a number, is
// never asked for.
struct Asked {
  static constexpr int kMost = 1 << 16;
  unsigned char flags[kMost] = {};
  ~Asked() {
    const char* const path = std::getenv("COASTMESH_MUTANTS_ASKED");
    std::FILE* const file = path == nullptr ? nullptr : std::fopen(path, "ab");
    if (file == nullptr) return;
    std::fwrite(flags, 1, kMost, file);
    std::fclose(file);
  }
};

inline Asked asked;

inline bool alive(int number) {
  static const int chosen = [] {
    const char* const text = std::getenv("COASTMESH_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  asked.flags[number] = 1;
  return number == chosen;
}

// Placed between operands: `a < b` is written `a < Less(7) < b`, with the same precedence. An operator with one
// replacement has one number; the next belongs to another mutant.
#define MUTANTS_OPERATOR(NAME, SIGN, FIRST, SECOND, NUMBERS)                                           \
  struct NAME {                                                                                        \
    int number;                                                                                        \
    explicit NAME(int given) : number(given) {}                                                        \
  };                                                                                                   \
  template <typename Left>                                                                             \
  struct NAME##After {                                                                                 \
    const Left& left;                                                                                  \
    int number;                                                                                        \
  };                                                                                                   \
  template <typename Left>                                                                             \
  NAME##After<Left> operator SIGN(const Left& left, NAME sign) {                                       \
    return {left, sign.number};                                                                        \
  }                                                                                                    \
  template <typename Left, typename Right>                                                             \
  auto operator SIGN(NAME##After<Left> before, const Right& right)->decltype(before.left SIGN right) { \
    if (alive(before.number)) return before.left FIRST right;                                          \
    if (NUMBERS == 2 && alive(before.number + 1)) return before.left SECOND right;                     \
    return before.left SIGN right;                                                                     \
  }

MUTANTS_OPERATOR(Less, <, <=, >=, 2)
MUTANTS_OPERATOR(LessOrEqual, <=, <, >, 2)
MUTANTS_OPERATOR(Greater, >, >=, <=, 2)
MUTANTS_OPERATOR(GreaterOrEqual, >=, >, <, 2)
MUTANTS_OPERATOR(Equal, ==, !=, !=, 1)
MUTANTS_OPERATOR(Unequal, !=, ==, ==, 1)
MUTANTS_OPERATOR(Plus, +, -, -, 1)
MUTANTS_OPERATOR(Minus, -, +, +, 1)
MUTANTS_OPERATOR(Divided, /, *, *, 1)
#undef MUTANTS_OPERATOR

// Replaces a * b by a / b, or by b / a if b is a vector.
struct Times {
  int number;
  explicit Times(int given) : number(given) {}
};
template <typename Left>
struct TimesAfter {
  const Left& left;
  int number;
};
template <typename Left>
TimesAfter<Left> operator*(const Left& left, Times sign) {
  return {left, sign.number};
}
template <typename Left, typename Right>
auto operator*(TimesAfter<Left> before, const Right& right) -> decltype(before.left * right) {
  if (alive(before.number)) {
    if constexpr (requires { before.left / right; }) {
      if constexpr (std::is_integral_v<Left> && std::is_integral_v<Right>) {
        if (right == 0) return before.left;
      }
      return before.left / right;
    } else {
      return (1.0 / before.left) * right;
    }
  }
  return before.left * right;
}

template <typename Number>
Number number(int number, Number value) {
  if (alive(number)) return static_cast<Number>(value + 1);
  if (alive(number + 1)) return std::is_integral_v<Number> ? static_cast<Number>(value - 1) : -value;
  return value;
}

inline double sign(int number) { return alive(number) ? 1.0 : -1.0; }

template <typename Condition>
bool negated(int number, const Condition& condition) {
  return alive(number) != static_cast<bool>(condition);
}

inline bool kept(int number) { return !alive(number); }

// Changes a returned value: to true or false for bool, 0 or one more for a number, a default value for other types.
template <typename Result>
Result returned(int number, Result&& value) {
  using Plain = std::remove_cvref_t<Result>;
  static thread_local std::conditional_t<std::default_initializable<Plain>, Plain, int> other;
  if constexpr (std::is_same_v<Plain, bool>) {
    if (alive(number)) return static_cast<Result>(other = true);
    if (alive(number + 1)) return static_cast<Result>(other = false);
  } else if constexpr (std::is_arithmetic_v<Plain>) {
    if (alive(number)) return static_cast<Result>(other = Plain{});
    if (alive(number + 1)) return static_cast<Result>(other = static_cast<Plain>(value + 1));
  } else if constexpr (std::default_initializable<Plain> && std::is_move_assignable_v<Plain>) {
    if (alive(number)) return static_cast<Result>(other = Plain{});
  }
  return static_cast<Result>(value);
}

struct Max {
  int number;
  template <typename T>
  T operator()(const T& a, const T& b) const {
    return alive(number) ? std::min(a, b) : std::max(a, b);
  }
  template <typename T>
  T operator()(std::initializer_list<T> all) const {
    return alive(number) ? std::min(all) : std::max(all);
  }
};

struct Min {
  int number;
  template <typename T>
  T operator()(const T& a, const T& b) const {
    return alive(number) ? std::max(a, b) : std::min(a, b);
  }
  template <typename T>
  T operator()(std::initializer_list<T> all) const {
    return alive(number) ? std::max(all) : std::min(all);
  }
};

struct Abs {
  int number;
  template <typename T>
  auto operator()(T value) const {
    return alive(number) ? value : std::abs(value);
  }
};

}  // namespace mutants
