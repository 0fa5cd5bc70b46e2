#pragma once
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "model/assembled_heat.h"
#include "model/reduced_heat.h"
#include "model/section_mesh.h"
#include "model/section_plan.h"
#include "model/thermo_elasticity.h"

/// Plain data as bytes, and back: for digests and for the cache's files, which only the machine that wrote them reads.
namespace rotordrop::plain {

/// Members of a struct as a tuple of references. A struct that gets or loses a member no longer compiles here: extend its list.
template <class T>
auto members(T& x) {
  using S = std::remove_const_t<T>;
  if constexpr (std::is_same_v<S, PropertyTable>) {
    return std::tie(x.points());
  } else if constexpr (std::is_same_v<S, HeatBoundary>) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else if constexpr (std::is_same_v<S, HeatBody>) {
    auto& [a, b, c, d, e, f, g] = x;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (std::is_same_v<S, HeatFlux>) {
    auto& [a, b, c, d, e, f] = x;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (std::is_same_v<S, HeatFixed> || std::is_same_v<S, HeatNode>) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (std::is_same_v<S, HeatConvection> || std::is_same_v<S, HeatPort>) {
    auto& [a, b, c, d] = x;
    return std::tie(a, b, c, d);
  } else if constexpr (std::is_same_v<S, HeatInterface> || std::is_same_v<S, HeatLink>) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else if constexpr (std::is_same_v<S, HeatNumerics>) {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (std::is_same_v<S, HeatConductionProblem>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = x;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (std::is_same_v<S, SectionMesh>) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (std::is_same_v<S, SectionMesh::Cell>) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (std::is_same_v<S, SectionMesh::Edge> || std::is_same_v<S, SectionMesh::Arc> ||
                       std::is_same_v<S, SectionPlan::Block>) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else if constexpr (std::is_same_v<S, SectionPlan>) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (std::is_same_v<S, SectionPlan::Point>) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (std::is_same_v<S, SectionPlan::Curve>) {
    auto& [a, b, c, d, e, f] = x;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (std::is_same_v<S, ReductionSettings>) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (std::is_same_v<S, AssembledHeat>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = x;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (std::is_same_v<S, HeatMean> || std::is_same_v<S, HeldUnknowns>) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (std::is_same_v<S, ReducedHeat>) {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (std::is_same_v<S, ReducedHeat::Output>) {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (std::is_same_v<S, ElasticBody>) {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (std::is_same_v<S, ElasticFit>) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (std::is_same_v<S, ElasticHold> || std::is_same_v<S, FitOpenings>) {
    auto& [a, b, c, d] = x;
    return std::tie(a, b, c, d);
  } else if constexpr (std::is_same_v<S, ElasticTraction> || std::is_same_v<S, ElasticOutput> ||
                       std::is_same_v<S, ElasticInfluence>) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else {
    static_assert(std::is_same_v<S, ElasticProblem>, "not a struct that is known here");
    auto& [a, b, c, d, e, f, g, h, i] = x;
    return std::tie(a, b, c, d, e, f, g, h, i);
  }
}

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsFunction : std::false_type {};
template <class F>
struct IsFunction<std::function<F>> : std::true_type {};
/// Copied as the bytes they are: numbers, and arrays of numbers (no padding).
template <class T>
struct IsNumeric : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <class T, std::size_t n>
struct IsNumeric<std::array<T, n>> : IsNumeric<T> {};

/// Appends values to bytes. Data that hold a function are not plain.
class Writer {
 public:
  template <class T>
  void add(const T& x) {
    if constexpr (IsNumeric<T>::value)
      raw(&x, sizeof(T));
    else if constexpr (std::is_same_v<T, std::string>)
      count(x.size()), raw(x.data(), x.size());
    else if constexpr (IsList<T>::value) {
      count(x.size());
      if constexpr (IsNumeric<typename T::value_type>::value)
        raw(x.data(), x.size() * sizeof(typename T::value_type));
      else
        for (const auto& item : x) add(item);
    } else if constexpr (IsOptional<T>::value) {
      add(x.has_value());
      if (x) add(*x);
    } else if constexpr (IsFunction<T>::value)
      is_plain_ = is_plain_ && !x;
    else
      std::apply([this](const auto&... member) { (this->add(member), ...); }, members(x));
  }
  /// Whether no function was among what was added.
  [[nodiscard]] bool is_plain() const { return is_plain_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void count(std::uint64_t n) { raw(&n, sizeof n); }
  void raw(const void* from, std::size_t n) {
    if (n > 0) bytes_.append(static_cast<const char*>(from), n);
  }
  std::string bytes_;
  bool is_plain_ = true;
};

/// Takes them back. @throws std::out_of_range if the bytes end too early
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  void get(T& x) {
    if constexpr (IsNumeric<T>::value)
      raw(&x, sizeof(T));
    else if constexpr (std::is_same_v<T, std::string>)
      x.resize(count(1)), raw(x.data(), x.size());
    else if constexpr (std::is_same_v<T, std::string_view>) {  // a view into the bytes, which must outlive it
      const std::size_t n = count(1);
      x = rest_.substr(0, n);
      rest_.remove_prefix(n);
    } else if constexpr (IsList<T>::value) {
      if constexpr (IsNumeric<typename T::value_type>::value) {
        x.resize(count(sizeof(typename T::value_type)));
        raw(x.data(), x.size() * sizeof(typename T::value_type));
      } else {
        x.resize(count(1));
        for (auto& item : x) get(item);
      }
    } else if constexpr (IsOptional<T>::value) {
      bool has_value = false;
      get(has_value);
      if (has_value) get(x.emplace());
    } else {
      std::apply([this](auto&... member) { (this->get(member), ...); }, members(x));
    }
  }
  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

 private:
  std::size_t count(std::size_t size) {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > rest_.size() / size) throw std::out_of_range("the bytes end too early");
    return n;
  }
  void raw(void* to, std::size_t n) {
    if (n > rest_.size()) throw std::out_of_range("the bytes end too early");
    if (n > 0) std::memcpy(to, rest_.data(), n);
    rest_.remove_prefix(n);
  }
  std::string_view rest_;
};

template <class T>
std::string bytes_of(const T& x) {
  Writer writer;
  writer.add(x);
  return writer.bytes();
}

/// SHA-256 of the content; nothing if it holds a function.
/// Of a problem in space: its fluxes over time and the accuracy in time do not count.
std::optional<std::string> digest_of(const HeatConductionProblem& problem);
std::optional<std::string> digest_of(const ElasticProblem& problem);
std::string digest_of(const SectionPlan& plan);
std::string digest_of(const ReductionSettings& settings);
std::string digest_of(std::span<const double> values);

}  // namespace rotordrop::plain
