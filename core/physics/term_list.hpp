#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/physics/filled_table.hpp"
#include "core/physics/term.hpp"

namespace drift {

/// A compile-time list of terms: numbering of parameters, lookup by name, application by mask. Its
/// last ones may be places (own/own_place.hpp): what stands there is known when a study is read. So
/// `terms` and `specs` hold what there is, and num_terms and num_params what there may be; whoever
/// loops over those asks a mask, and no mask holds an empty place.
template <Term... Ts>
struct TermList {
  static constexpr std::size_t num_terms = sizeof...(Ts);
  static constexpr std::size_t num_params = (Ts::params.size() + ...);
  using Mask = std::bitset<num_terms>;
  using ParamMask = std::bitset<num_params>;

  static constexpr int num_memory = (memory_of<Ts>() + ... + 0);

  /// Terms and parameters that are known when the program is compiled; places have no names.
  static constexpr std::size_t num_known = (std::size_t{!is_place<Ts>()} + ...);
  static constexpr std::size_t num_known_params = ((is_place<Ts>() ? 0 : Ts::params.size()) + ...);
  static constexpr auto known_specs = join(Ts::params...);
  static constexpr auto known_terms = [] {
    std::array<TermInfo, num_terms> infos{};
    std::size_t next = 0, first = 0;
    int memory = 0;
    ((infos[next++] = {Ts::key, Ts::title, Ts::equation, Ts::source, Ts::subsystem, first,
                       Ts::params.size(), ActsOnRates<Ts, double>, ActsOnReadout<Ts, double>,
                       ActsOnGimbals<Ts, double>, OffsetsAttitude<Ts, double>, needs_of<Ts>(),
                       memory, memory_of<Ts>(), drift::wants_swing<Ts>()},
      first += Ts::params.size(), memory += memory_of<Ts>()),
     ...);
    return infos;
  }();

 private:
  static inline FilledTable<ParamSpec, num_params> specs_{known_specs, num_known_params};
  static inline FilledTable<TermInfo, num_terms> terms_{known_terms, num_known};

 public:
  /// All that there is, the places that are filled among it.
  static constexpr const FilledTable<ParamSpec, num_params>& specs = specs_;
  static constexpr const FilledTable<TermInfo, num_terms>& terms = terms_;

  static std::optional<std::size_t> find(std::string_view key) {
    for (std::size_t i = 0; i < specs.size(); ++i)
      if (specs[i].key.view() == key) return i;
    return std::nullopt;
  }
  /// The term that owns parameter i; one without name if that is a place which nobody took.
  static const TermInfo& owner(std::size_t i) {
    static constexpr TermInfo nobody{};
    for (const TermInfo& term : terms)
      if (i < term.first + term.count) return term;
    return nobody;
  }
  /// Index of a parameter, of a term, named in the code; a typo does not compile.
  static consteval std::size_t index(std::string_view key) {
    std::size_t i = 0;
    while (known_specs[i].key.view() != key) ++i;
    return i;
  }
  static consteval std::size_t term_index(std::string_view key) {
    std::size_t t = 0;
    while (known_terms[t].key != key) ++t;
    return t;
  }

  static std::optional<std::size_t> find_term(std::string_view key) {
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (terms[i].key == key) return i;
    return std::nullopt;
  }

  /// What comes into a place.
  struct Filling {
    TermInfo info;  ///< but `first`, which is said here
    std::span<const ParamSpec> params;
  };
  /// Fills the places in their order and empties the rest. Not while other threads use the list.
  static void fill_places(std::span<const Filling> fillings) {
    specs_ = {known_specs, num_known_params};
    terms_ = {known_terms, num_known};
    places_ = {};
    for (const Filling& f : fillings) {
      TermInfo info = f.info;
      info.first = specs_.size();
      const std::size_t t = terms_.size();
      places_.rates[t] = info.in_rates;
      places_.readout[t] = info.in_readout;
      places_.gimbals[t] = info.in_gimbals;
      terms_.add(info);
      for (const ParamSpec& spec : f.params) specs_.add(spec);
    }
  }

  /// The parameters of the terms in `mask`.
  static ParamMask params_of(const Mask& mask) {
    ParamMask params;
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (mask[t])
        for (std::size_t i = 0; i < terms[t].count; ++i) params.set(terms[t].first + i);
    return params;
  }
  /// The mask with what its terms cannot do without: their time constants, harmonic numbers and the
  /// like, which belong to no axis. "warmup_drift.x" needs the time constant of all three.
  static ParamMask completed(ParamMask params) {
    const Mask owners = terms_of(params);
    for (std::size_t t = 0; t < terms.size(); ++t)
      for (std::size_t i = terms[t].first; owners[t] && i < terms[t].first + terms[t].count; ++i)
        if (!specs[i].amplitude() && specs[i].axis.empty()) params.set(i);
    return params;
  }
  /// The terms that own at least one parameter of `params`.
  static Mask terms_of(const ParamMask& params) {
    Mask mask;
    for (std::size_t t = 0; t < terms.size(); ++t)
      for (std::size_t i = 0; i < terms[t].count; ++i)
        if (params[terms[t].first + i]) mask.set(t);
    return mask;
  }

  /// What the terms of a mask need together.
  static Needs needs(const Mask& mask) {
    constexpr Mask needy = selected([](const TermInfo& t) { return t.needs.any(); });
    Needs all;
    if ((mask & (needy | every_place())).none()) return all;
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (mask[t]) all = all | terms[t].needs;
    return all;
  }
  static bool offset_attitude(const Mask& mask) {
    constexpr Mask which = selected([](const TermInfo& t) { return t.in_offset; });
    return (mask & which).any();
  }
  static bool act_on_gimbals(const Mask& mask) {
    constexpr Mask which = selected([](const TermInfo& t) { return t.in_gimbals || t.in_offset; });
    return (mask & (which | places_.gimbals)).any();
  }
  static bool remember(const Mask& mask) { return num_memory > 0 && needs(mask).memory; }

  template <class S>
  static void rates(const Mask& mask, const Inputs<S>& in, const S* theta, RateAssembly<S>& out) {
    for_first([&]<class T>(std::size_t t) {
      if constexpr (ActsOnRates<T, S>)
        if (mask[t]) call_rates<T>(t, in, theta, out);
    });
    constexpr Mask rest = selected(
        [](const TermInfo& t) { return t.in_rates && t.first >= known_terms[num_inline].first; });
    if ((mask & (rest | places_.rates)).any()) further_rates(mask, in, theta, out);
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
      return t.in_offset || (t.in_readout && t.first >= known_terms[num_inline].first);
    });
    return (mask & (rest | places_.readout)).none();
  }
  template <class S>
  static void first_readout(const Mask& mask, const Inputs<S>& in, const S* theta,
                            ReadoutAssembly<S>& out) {
    for_first([&]<class T>(std::size_t t) {
      if constexpr (ActsOnReadout<T, S>)
        if (mask[t]) T::readout(in, theta + first_of<T>(t), out);
    });
  }
  template <class S>
  static void readout(const Mask& mask, const Inputs<S>& in, const S* theta,
                      ReadoutAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnReadout<T, S>)
        if (mask[t]) T::readout(in, theta + first_of<T>(t), out);
    });
  }
  template <class S>
  static void gimbals(const Mask& mask, const Inputs<S>& in, const S* theta,
                      GimbalAssembly<S>& out) {
    for_each([&]<class T>(std::size_t t) {
      if constexpr (ActsOnGimbals<T, S>)
        if (mask[t]) T::gimbals(in, theta + first_of<T>(t), out);
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
          T::attitude_offset(in, theta + first_of<T>(t),
                             in.around->memory + known_terms[t].first_memory, delta_p);
        else
          T::attitude_offset(in, theta + first_of<T>(t), delta_p);
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
  /// The terms known when the program is compiled for which a condition on TermInfo holds.
  static constexpr Mask selected(auto&& condition) {
    static_assert(num_terms <= 64, "a mask is made of one word");
    unsigned long long bits = 0;
    for (std::size_t t = 0; t < num_known; ++t)
      if (condition(known_terms[t])) bits |= 1ull << t;
    return Mask(bits);
  }

  /// Whether every parameter has a name of its own.
  static consteval bool unique_keys() {  // sorted: clang does not go on for as long as pairs take
    std::array<std::string_view, num_known_params> keys;
    for (std::size_t i = 0; i < num_known_params; ++i) keys[i] = known_specs[i].key.view();
    std::sort(keys.begin(), keys.end());
    return std::adjacent_find(keys.begin(), keys.end()) == keys.end();
  }

 private:
  /// The base terms and frame_closure come first, and are tested one by one without a call.
  static constexpr std::size_t num_inline = num_terms > 7 ? 7 : num_terms - 1;

  static constexpr Mask every_place() {
    return Mask((~0ull >> (64 - num_terms)) & ~(~0ull >> (64 - num_known)));
  }
  /// The places by what their terms act on.
  struct Places {
    Mask rates, readout, gimbals;
  };
  static inline Places places_;

  /// Index of the first parameter of a term; that of a place depends on the places before it.
  template <class T>
  static std::size_t first_of(std::size_t t) {
    if constexpr (is_place<T>())
      return terms[t].first;
    else
      return known_terms[t].first;
  }

  template <class T, class S>
  static void call_rates(std::size_t t, const Inputs<S>& in, const S* theta, RateAssembly<S>& out) {
    if constexpr (memory_of<T>() > 0)
      T::rates(in, theta + first_of<T>(t), in.around->memory + known_terms[t].first_memory, out);
    else
      T::rates(in, theta + first_of<T>(t), out);
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

  static_assert(((is_place<Ts>() || !ActsOnRates<Ts, double> ||
                  !(ActsOnReadout<Ts, double> || ActsOnGimbals<Ts, double> ||
                    OffsetsAttitude<Ts, double>)) &&
                 ...),
                "a term acts on the rates or on the readout, not on both");
};

}  // namespace drift
