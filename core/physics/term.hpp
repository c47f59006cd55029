#pragma once

#include <bitset>
#include <concepts>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/params/param_spec.hpp"
#include "core/physics/assembly.hpp"

namespace drift {

/// A physical effect. It declares its parameters once and adds to the slots it acts on, through
/// `rates` (the platform's rate equation), `readout` (what the instruments say), or both.
template <class T>
concept Term = requires {
  { T::key } -> std::convertible_to<std::string_view>;
  { T::title } -> std::convertible_to<std::string_view>;
  { T::equation } -> std::convertible_to<std::string_view>;
  { T::source } -> std::convertible_to<std::string_view>;
  { T::params.size() } -> std::convertible_to<std::size_t>;
};

template <class T, class S>
concept ActsOnRates = requires(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
  T::rates(in, p, out);
};
template <class T, class S>
concept ActsOnReadout = requires(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
  T::readout(in, p, out);
};

/// What the `terms` command and error messages need to know of a term.
struct TermInfo {
  std::string_view key, title, equation, source;
  std::size_t first = 0;  ///< index of its first parameter
  std::size_t count = 0;  ///< number of its parameters
  bool in_rates = false;    ///< acts on the platform's rate
  bool in_readout = false;  ///< acts on what the instruments say
};

/// A compile-time list of terms: numbering of parameters, lookup by name, application by mask.
template <Term... Ts>
struct TermList {
  static constexpr std::size_t num_terms = sizeof...(Ts);
  static constexpr std::size_t num_params = (Ts::params.size() + ...);
  using Mask = std::bitset<num_terms>;
  using ParamMask = std::bitset<num_params>;

  static constexpr auto specs = join(Ts::params...);

  static constexpr auto terms = [] {
    std::array<TermInfo, num_terms> infos{};
    std::size_t next = 0, first = 0;
    ((infos[next++] = {Ts::key, Ts::title, Ts::equation, Ts::source, first, Ts::params.size(),
                       ActsOnRates<Ts, double>, ActsOnReadout<Ts, double>},
      first += Ts::params.size()),
     ...);
    return infos;
  }();

  static constexpr std::optional<std::size_t> find(std::string_view key) {
    for (std::size_t i = 0; i < num_params; ++i)
      if (specs[i].key.view() == key) return i;
    return std::nullopt;
  }
  /// The term that owns parameter i.
  static constexpr const TermInfo& owner(std::size_t i) {
    std::size_t t = 0;
    while (i >= terms[t].first + terms[t].count) ++t;
    return terms[t];
  }
  /// Index of a parameter named in the code; a typo does not compile.
  static consteval std::size_t index(std::string_view key) { return find(key).value(); }

  static constexpr std::optional<std::size_t> find_term(std::string_view key) {
    for (std::size_t i = 0; i < num_terms; ++i)
      if (terms[i].key == key) return i;
    return std::nullopt;
  }

  /// The parameters of the terms in `mask`.
  static ParamMask params_of(const Mask& mask) {
    ParamMask params;
    for (std::size_t t = 0; t < num_terms; ++t)
      if (mask[t])
        for (std::size_t i = 0; i < terms[t].count; ++i) params.set(terms[t].first + i);
    return params;
  }
  /// The terms that own at least one parameter of `params`.
  static Mask terms_of(const ParamMask& params) {
    Mask mask;
    for (std::size_t t = 0; t < num_terms; ++t)
      for (std::size_t i = 0; i < terms[t].count; ++i)
        if (params[terms[t].first + i]) mask.set(t);
    return mask;
  }

  template <class S>
  static void rates(const Mask& mask, const Inputs<S>& in, const S* theta, RateAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnRates<T, S>)
        if (mask[t]) T::rates(in, theta + terms[t].first, out);
    });
  }
  template <class S>
  static void readout(const Mask& mask, const Inputs<S>& in, const S* theta, ReadoutAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnReadout<T, S>)
        if (mask[t]) T::readout(in, theta + terms[t].first, out);
    });
  }

 private:
  static constexpr void for_each(auto&& visit) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit.template operator()<Ts>(I), ...);
    }(std::index_sequence_for<Ts...>{});
  }

  static consteval bool unique_keys() {
    for (std::size_t i = 0; i < num_params; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (specs[i].key == specs[k].key) return false;
    return true;
  }
  static_assert(unique_keys(), "two parameters have the same key");
};

}  // namespace drift
