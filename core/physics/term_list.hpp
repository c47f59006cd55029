#pragma once

#include <bitset>
#include <optional>
#include <tuple>
#include <utility>

#include "core/physics/term.hpp"

namespace drift {

/// A compile-time list of terms: numbering of parameters, lookup by name, application by mask.
template <Term... Ts>
struct TermList {
  static constexpr std::size_t num_terms = sizeof...(Ts);
  static constexpr std::size_t num_params = (Ts::params.size() + ...);
  using Mask = std::bitset<num_terms>;
  using ParamMask = std::bitset<num_params>;

  static constexpr auto specs = join(Ts::params...);

  static constexpr int num_memory = (memory_of<Ts>() + ... + 0);

  static constexpr auto terms = [] {
    std::array<TermInfo, num_terms> infos{};
    std::size_t next = 0, first = 0;
    int memory = 0;
    ((infos[next++] = {Ts::key, Ts::title, Ts::equation, Ts::source, Ts::subsystem, first,
                       Ts::params.size(), ActsOnRates<Ts, double>, ActsOnReadout<Ts, double>,
                       ActsOnGimbals<Ts, double>, OffsetsAttitude<Ts, double>, needs_of<Ts>(),
                       memory, memory_of<Ts>()},
      first += Ts::params.size(), memory += memory_of<Ts>()),
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
  /// The mask with what its terms cannot do without: their time constants, harmonic numbers and the
  /// like, which belong to no axis. "warmup_drift.x" needs the time constant of all three.
  static ParamMask completed(ParamMask params) {
    const Mask owners = terms_of(params);
    for (std::size_t t = 0; t < num_terms; ++t)
      for (std::size_t i = terms[t].first; owners[t] && i < terms[t].first + terms[t].count; ++i)
        if (!specs[i].amplitude() && specs[i].axis.empty()) params.set(i);
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

  /// What the terms of a mask need together.
  static Needs needs(const Mask& mask) {
    constexpr Mask needy = selected([](const TermInfo& t) { return t.needs.any(); });
    Needs all;
    if ((mask & needy).none()) return all;
    for (std::size_t t = 0; t < num_terms; ++t)
      if (mask[t]) all = all | terms[t].needs;
    return all;
  }
  static bool offset_attitude(const Mask& mask) {
    constexpr Mask which = selected([](const TermInfo& t) { return t.in_offset; });
    return (mask & which).any();
  }
  static bool act_on_gimbals(const Mask& mask) {
    constexpr Mask which = selected([](const TermInfo& t) { return t.in_gimbals || t.in_offset; });
    return (mask & which).any();
  }
  static bool remember(const Mask& mask) { return num_memory > 0 && needs(mask).memory; }

  template <class S>
  static void rates(const Mask& mask, const Inputs<S>& in, const S* theta, RateAssembly<S>& out) {
    for_first([&]<class T>(std::size_t t) {
      if constexpr (ActsOnRates<T, S>)
        if (mask[t]) call_rates<T>(t, in, theta, out);
    });
    constexpr Mask rest = selected(
        [](const TermInfo& t) { return t.in_rates && t.first >= terms[num_inline].first; });
    if ((mask & rest).any()) further_rates(mask, in, theta, out);
  }
  /// The rates of all but the first terms, which every model has. Kept out of the way of those.
  template <class S>
  [[gnu::noinline]] static void further_rates(const Mask& mask, const Inputs<S>& in, const S* theta,
                                              RateAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnRates<T, S>)
        if (t >= num_inline && mask[t]) call_rates<T>(t, in, theta, out);
    });
  }
  /// Whether the accelerometers are read by the first terms alone.
  static bool plain_readout(const Mask& mask) {
    constexpr Mask rest = selected([](const TermInfo& t) {
      return t.in_offset || (t.in_readout && t.first >= terms[num_inline].first);
    });
    return (mask & rest).none();
  }
  template <class S>
  static void first_readout(const Mask& mask, const Inputs<S>& in, const S* theta,
                            ReadoutAssembly<S>& out) {
    for_first([&]<class T>(std::size_t t) {
      if constexpr (ActsOnReadout<T, S>)
        if (mask[t]) T::readout(in, theta + terms[t].first, out);
    });
  }
  template <class S>
  static void readout(const Mask& mask, const Inputs<S>& in, const S* theta,
                      ReadoutAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnReadout<T, S>)
        if (mask[t]) T::readout(in, theta + terms[t].first, out);
    });
  }
  template <class S>
  static void gimbals(const Mask& mask, const Inputs<S>& in, const S* theta,
                      GimbalAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnGimbals<T, S>)
        if (mask[t]) T::gimbals(in, theta + terms[t].first, out);
    });
  }
  /// Sum of the attitude offsets, platform axes [rad].
  template <class S>
  static Vec3T<S> attitude_offset(const Mask& mask, const Inputs<S>& in, const S* theta) {
    Vec3T<S> delta_p = Vec3T<S>::Zero();
    for_each([&]<class T>(std::size_t t) {
      if constexpr (OffsetsAttitude<T, S>) {
        if (!mask[t]) return;
        if constexpr (memory_of<T>() > 0)
          T::attitude_offset(in, theta + terms[t].first, in.around->memory + terms[t].first_memory,
                             delta_p);
        else
          T::attitude_offset(in, theta + terms[t].first, delta_p);
      }
    });
    return delta_p;
  }

  /// Calls visit.template operator()<T>(info) for every term of the mask.
  static void for_each_of(const Mask& mask, auto&& visit) {
    for_each([&]<class T>(std::size_t t) {
      if (mask[t]) visit.template operator()<T>(terms[t]);
    });
  }
  /// The same for those that have memory.
  static void for_each_memory(const Mask& mask, auto&& visit) {
    for_each_of(mask, [&]<class T>(const TermInfo& info) {
      if constexpr (memory_of<T>() > 0) visit.template operator()<T>(info);
    });
  }
  /// The terms for which a condition on TermInfo holds.
  static constexpr Mask selected(auto&& condition) {
    static_assert(num_terms <= 64, "a mask is made of one word");
    unsigned long long bits = 0;
    for (std::size_t t = 0; t < num_terms; ++t)
      if (condition(terms[t])) bits |= 1ull << t;
    return Mask(bits);
  }

  /// Whether every parameter has a name of its own.
  static consteval bool unique_keys() {
    for (std::size_t i = 0; i < num_params; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (specs[i].key == specs[k].key) return false;
    return true;
  }

 private:
  /// The base terms and frame_closure come first, and are tested one by one without a call.
  static constexpr std::size_t num_inline = num_terms > 7 ? 7 : num_terms - 1;

  template <class T, class S>
  static void call_rates(std::size_t t, const Inputs<S>& in, const S* theta, RateAssembly<S>& out) {
    if constexpr (memory_of<T>() > 0)
      T::rates(in, theta + terms[t].first, in.around->memory + terms[t].first_memory, out);
    else
      T::rates(in, theta + terms[t].first, out);
  }

  /// The first terms alone: nothing is made of the others where this is called.
  static constexpr void for_first(auto&& visit) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit.template operator()<std::tuple_element_t<I, std::tuple<Ts...>>>(I), ...);
    }
    (std::make_index_sequence<num_inline>{});
  }
  static constexpr void for_each(auto&& visit) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit.template operator()<Ts>(I), ...);
    }
    (std::index_sequence_for<Ts...>{});
  }

  static_assert(((!ActsOnRates<Ts, double> ||
                  !(ActsOnReadout<Ts, double> || ActsOnGimbals<Ts, double> ||
                    OffsetsAttitude<Ts, double>)) &&
                 ...),
                "a term acts on the rates or on the readout, not on both");
};

}  // namespace drift
