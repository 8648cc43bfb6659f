#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/point.hpp"
#include "core/refine/refine_options.hpp"

namespace coastmesh {

// Values as bytes, for one version of coastmesh on one kind of machine, read back bit for bit. A type that is neither
// plain nor from the standard library has a function partsOf that lists its members.

// All members except the list of missed bounds, which is made from the whole mesh at the end.
auto partsOf(auto& stats) requires std::is_same_v<std::remove_cvref_t<decltype(stats)>, RefineStats> {
  auto& [steiner_points, by_type, segment_splits, relocations, removals, merges, unmended, budget_reached, unresolved] =
      stats;
  return std::tie(steiner_points, by_type, segment_splits, relocations, removals, merges, unmended, budget_reached);
}

// Types without padding between members: copied as raw memory.
template <typename T>
struct HasNoGaps : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Point>> {};
template <typename T, std::size_t N>
struct HasNoGaps<std::array<T, N>> : HasNoGaps<T> {};
template <typename T>
concept Plain = HasNoGaps<T>::value && std::is_trivially_copyable_v<T>;

// `Sink::append(data, size)` receives the bytes.
template <typename Sink>
class BasicByteWriter {
 public:
  explicit BasicByteWriter(Sink sink = {}) : sink_(std::move(sink)) {}
  Sink take() { return std::move(sink_); }

  template <Plain T>
  void pass(const T& value) {
    sink_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void pass(const std::string& text) { passAll(text); }
  template <typename T, typename Allocator>
  void pass(const std::vector<T, Allocator>& values) {
    passAll(values);
  }
  template <typename A, typename B>
  void pass(const std::pair<A, B>& both) {
    pass(both.first);
    pass(both.second);
  }
  template <typename T>
  void pass(const std::optional<T>& value) {
    pass(value.has_value());
    if (value) pass(*value);
  }
  template <typename... Ts>
  void pass(const std::variant<Ts...>& value) {
    pass(static_cast<std::uint64_t>(value.index()));
    std::visit([this](const auto& held) { this->pass(held); }, value);
  }
  template <typename T>
  void pass(const T& whole) requires requires {
    partsOf(whole);
  }
  {
    std::apply([this](const auto&... parts) { (this->pass(parts), ...); }, partsOf(whole));
  }
  // Eight flags per byte.
  template <typename Flags>
  void passFlags(const Flags& flags) {
    pass(static_cast<std::uint64_t>(flags.size()));
    std::vector<std::uint8_t> bytes((flags.size() + 7) / 8, 0);
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i]) bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | (1u << (i % 8)));
    pass(bytes);
  }

 private:
  template <typename Items>
  void passAll(const Items& items) {
    pass(static_cast<std::uint64_t>(items.size()));
    if constexpr (Plain<typename Items::value_type>) {
      sink_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
    } else {
      for (const auto& item : items) pass(item);
    }
  }

  Sink sink_;
};
using ByteWriter = BasicByteWriter<std::string>;

// Passes bytes on as they arrive. The given function must outlive it.
struct PutSink {
  const std::function<void(std::string_view)>* put = nullptr;
  void append(const char* bytes, std::size_t size) const { (*put)({bytes, size}); }
};

// Every call throws Error, constructed from a text, if the bytes end too early; the message names them as `what`.
template <typename Error>
class BasicByteReader {
 public:
  BasicByteReader(std::string_view bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}
  bool atEnd() const { return at_ == bytes_.size(); }

  template <Plain T>
  void pass(T& value) {
    copy(&value, sizeof value);
  }
  void pass(bool& value) {
    std::uint8_t byte = 0;
    pass(byte);
    if (byte > 1) throw Error(what_ + " is damaged");
    value = byte == 1;
  }
  void pass(std::string& text) { passAll(text); }
  template <typename T, typename Allocator>
  void pass(std::vector<T, Allocator>& values) {
    passAll(values);
  }
  template <typename A, typename B>
  void pass(std::pair<A, B>& both) {
    pass(both.first);
    pass(both.second);
  }
  template <typename T>
  void pass(std::optional<T>& value) {
    bool has = false;
    pass(has);
    if (has) pass(value.emplace());
  }
  template <typename... Ts>
  void pass(std::variant<Ts...>& value) {
    std::uint64_t index = 0;
    pass(index);
    if (index >= sizeof...(Ts)) throw Error(what_ + " is damaged");
    std::uint64_t i = 0;
    ((i++ == index ? passAs<Ts>(value) : void()), ...);
  }
  template <typename T>
  void pass(T& whole) requires requires {
    partsOf(whole);
  }
  {
    std::apply([this](auto&... parts) { (this->pass(parts), ...); }, partsOf(whole));
  }
  template <typename Flags>
  void passFlags(Flags& flags) {
    std::uint64_t count = 0;
    std::vector<std::uint8_t> bytes;
    pass(count);
    pass(bytes);
    if (count / 8 + (count % 8 != 0) != bytes.size()) throw Error(what_ + " is damaged");
    flags.resize(count);
    for (std::size_t i = 0; i < count; ++i) flags[i] = (bytes[i / 8] >> (i % 8) & 1u) != 0;
  }
  // A view of the next `size` bytes, valid as long as the reader's input.
  std::string_view passView(std::uint64_t size) {
    need(size);
    const std::string_view view = bytes_.substr(at_, size);
    at_ += size;
    return view;
  }

 private:
  void need(std::uint64_t size) const {
    if (size > bytes_.size() - at_) throw Error(what_ + " ends too early");
  }
  template <typename T, typename Variant>
  void passAs(Variant& value) {
    T held{};
    pass(held);
    value = std::move(held);
  }
  void copy(void* to, std::size_t size) {
    need(size);
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  template <typename Items>
  void passAll(Items& items) {
    std::uint64_t count = 0;
    pass(count);
    // Every item takes at least one byte.
    need(count);
    items.resize(count);
    if constexpr (Plain<typename Items::value_type>) {
      copy(items.data(), items.size() * sizeof(items[0]));
    } else {
      for (auto& item : items) pass(item);
    }
  }

  std::string_view bytes_;
  std::string what_;
  std::size_t at_ = 0;
};

}  // namespace coastmesh
