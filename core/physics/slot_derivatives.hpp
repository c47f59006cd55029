#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "core/base/dual.hpp"
#include "core/base/pack.hpp"
#include "core/physics/dependence.hpp"
#include "core/physics/hooks.hpp"
#include "core/physics/term_library.hpp"

namespace drift {

/// What the terms see at one instant, and the numbers they see it with. Not copied: the inputs
/// point to the surroundings.
template <class S>
struct SeenByTerms {
  Inputs<S> still;            ///< at the attitude itself
  Inputs<Dual<3, S>> at_psi;  ///< with derivatives with respect to three directions of attitude
  const S* theta = nullptr;   ///< every parameter of TermLibrary
  const S* memory = nullptr;  ///< of all terms; null where none has any
  const S* memory_derivative = nullptr;  ///< each with respect to its term's parameter
};

/// Whether a term can be worked out for several instants in lock step (Pack): it sees attitude and
/// command alone. What else a term may see belongs to one instant.
template <class T>
constexpr bool in_lanes() {
  return !is_place<T>() && !needs_of<T>().any();
}
/// The terms of a mask that can, and those that cannot.
inline TermMask those_in_lanes(const TermMask& terms) {
  constexpr TermMask which =
      TermLibrary::selected([](const TermInfo& t) { return !t.needs.any(); });
  return terms & which;
}
inline TermMask those_apart(const TermMask& terms) {
  return terms & ~those_in_lanes(terms);
}
inline bool all_in_lanes(const TermMask& terms) {
  return those_apart(terms).none();
}

/// Whether a term can be worked out for several runs at one instant: what belongs to the instant is
/// the same in all lanes; what the past has left is not, nor which gimbal a term that asks for
/// their angles looks at.
template <class T>
constexpr bool at_one_instant() {
  return !is_place<T>() && !needs_of<T>().memory && !needs_of<T>().gimbals;
}
inline bool all_at_one_instant(const TermMask& terms) {
  constexpr TermMask which =
      TermLibrary::selected([](const TermInfo& t) { return !t.needs.memory && !t.needs.gimbals; });
  return (terms & ~which).none() && (terms >> TermLibrary::num_known).none();
}

/// What lanes stand for: instants of one run, or runs at one instant.
enum class LanesAre { instants, runs };

/// An instant at which every term has something to do, to find out what depends on what. Refers to
/// the mounting: which slots a gyro's parameters meet is of its axes.
SeenByTerms<Dependence> scene_of_dependence(const Mounting& mounting);

/// The slots of one hook, summed over the terms of a model, and their derivatives: with respect to
/// three directions of attitude by dual numbers, each term once; with respect to the states of a
/// layout by differences, exact because a hook is affine in a parameter of ParamKind::linear.
/// Parameters that meet in no slot (the three axes of a group, as a rule) share an evaluation. A
/// nonlinear parameter, or one that memory depends on, takes a dual number of its own.
///
/// Hooks may only add to their slots (term.hpp). Allocates nothing once it is built.
template <class Hook, class S, LanesAre lanes = LanesAre::instants>
class SlotDerivatives {
  /// Whether a term is worked out with such numbers.
  template <class T>
  static constexpr bool knows = std::same_as<S, double> ||
                                (lanes == LanesAre::runs ? at_one_instant<T>() : in_lanes<T>());

 public:
  static constexpr int slots = Hook::slots;
  using D3 = Dual<3, S>;
  using Sum = typename Hook::template Assembly<D3>;
  using Slots = std::array<D3, static_cast<std::size_t>(Hook::slots)>;

  /// A slot that depends on a state.
  struct Entry {
    std::size_t state = 0;
    int slot = 0;
  };

  /// states: library index of each, in the order of a layout. Of several instants at once no term
  /// may be among `terms` that is not in_lanes, of several runs none that is not at_one_instant.
  SlotDerivatives(const TermMask& terms, const Mounting& mounting,
                  const std::vector<std::size_t>& states) {
    TermLibrary::for_each_of(terms, [&]<class T>(const TermInfo& info) {
      if constexpr (Hook::template has<T> && knows<T>)
        if (Hook::acts(info)) add<T>(info, mounting, states);
    });
  }

  bool any() const { return !terms_.empty(); }
  /// Those of one state stand together.
  const std::vector<Entry>& entries() const { return entries_; }

  /// Adds the terms' slots to `sum`, with derivatives with respect to the directions of at_psi.
  void add_to(const SeenByTerms<S>& seen, Sum& sum) const {
    for (const OneTerm& t : terms_) t.value(seen, t, sum);
  }
  /// The same without derivatives.
  void add_plain_to(const SeenByTerms<S>& seen, typename Hook::template Assembly<S>& sum) const {
    for (const OneTerm& t : terms_) t.plain(seen, t, sum);
  }
  /// The slots of the terms, as they stand in a row.
  Slots slots_of(const SeenByTerms<S>& seen) const {
    Sum sum;
    add_to(seen, sum);
    Slots out;
    for (int k = 0; k < slots; ++k)
      out[static_cast<std::size_t>(k)] = Hook::template slot<D3>(sum, k);
    return out;
  }
  /// d slot / d state of every entry, SI.
  void differentiate(const SeenByTerms<S>& seen, S* out) const {
    for (const OneTerm& t : terms_) t.derivative(seen, t, out);
  }

 private:
  /// Parameters of a term that one evaluation differentiates by, and where the result goes.
  struct Together {
    bool affine = true;
    std::vector<std::size_t> params;
    std::vector<std::pair<int, std::size_t>> slot_to_entry;
    std::uint32_t met = 0;  ///< slots
  };
  struct OneTerm {
    std::size_t first = 0, first_memory = 0;
    std::vector<Together> groups;
    void (*value)(const SeenByTerms<S>&, const OneTerm&, Sum&) = nullptr;
    void (*derivative)(const SeenByTerms<S>&, const OneTerm&, S*) = nullptr;
    void (*plain)(const SeenByTerms<S>&, const OneTerm&,
                  typename Hook::template Assembly<S>&) = nullptr;
  };

  template <class T>
  void add(const TermInfo& info, const Mounting& mounting, const std::vector<std::size_t>& states);

  // Flattened: what a term is made of are many small products, which cost more to call than to do.
  template <class T>
  [[gnu::flatten]] static void value(const SeenByTerms<S>& seen, const OneTerm& t, Sum& sum) {
    std::array<D3, T::params.size()> p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = D3(seen.theta[t.first + k]);
    std::array<D3, memory_of<T>() + 1> m;
    for (std::size_t k = 0; k + 1 < m.size(); ++k) m[k] = D3(seen.memory[t.first_memory + k]);
    Hook::template add<T, D3>(seen.at_psi, p.data(), m.data(), sum);
  }

  template <class T>
  [[gnu::flatten]] static void plain(const SeenByTerms<S>& seen, const OneTerm& t,
                                     typename Hook::template Assembly<S>& sum) {
    const S* memory = memory_of<T>() > 0 ? seen.memory + t.first_memory : nullptr;
    Hook::template add<T, S>(seen.still, seen.theta + t.first, memory, sum);
  }

  template <class T>
  [[gnu::flatten]] static void derivative(const SeenByTerms<S>& seen, const OneTerm& t, S* out) {
    const S* theta = seen.theta + t.first;
    const S* memory = memory_of<T>() > 0 ? seen.memory + t.first_memory : nullptr;
    std::array<S, T::params.size()> p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = theta[k];
    typename Hook::template Assembly<S> here;
    Hook::template add<T, S>(seen.still, p.data(), memory, here);
    for (const Together& group : t.groups) {
      if (!group.affine) {
        tangent<T>(seen, t, group, out);
        continue;
      }
      for (const std::size_t k : group.params) p[k] = theta[k] + S(1.0);
      typename Hook::template Assembly<S> there;
      Hook::template add<T, S>(seen.still, p.data(), memory, there);
      for (const std::size_t k : group.params) p[k] = theta[k];
      for (const auto& [slot, entry] : group.slot_to_entry)
        out[entry] = Hook::template slot<S>(there, slot) - Hook::template slot<S>(here, slot);
    }
  }

  /// One parameter, in which the hook need not be affine.
  template <class T>
  static void tangent(const SeenByTerms<S>& seen, const OneTerm& t, const Together& group, S* out) {
    using D = Dual<1, S>;
    const std::size_t param = group.params.front();
    std::array<D, T::params.size()> p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = D(seen.theta[t.first + k]);
    p[param].d[0] = S(1.0);
    std::array<D, memory_of<T>() + 1> m;
    if constexpr (memory_of<T>() > 0)
      for (std::size_t k = 0; k + 1 < m.size(); ++k) {
        m[k] = D(seen.memory[t.first_memory + k]);
        if (param == T::memory_parameter) m[k].d[0] = seen.memory_derivative[t.first_memory + k];
      }
    Surroundings<D> around;
    Inputs<D> in;
    in.mounting = seen.still.mounting;
    in.f_p = seen.still.f_p.template cast<D>();
    in.omega_ic_p = seen.still.omega_ic_p.template cast<D>();
    in.omega_cmd_p = seen.still.omega_cmd_p;
    if (seen.still.around) {
      around.now = seen.still.around->now;
      around.R_lp = seen.still.around->R_lp.template cast<D>();
      around.gimbal = seen.still.around->gimbal.template cast<D>();
      around.omega_drift_p = seen.still.around->omega_drift_p;
      in.around = &around;
    }
    typename Hook::template Assembly<D> there;
    Hook::template add<T, D>(in, p.data(), m.data(), there);
    for (const auto& [slot, entry] : group.slot_to_entry)
      out[entry] = Hook::template slot<D>(there, slot).d[0];
  }

  std::vector<OneTerm> terms_;
  std::vector<Entry> entries_;
};

/// The slots that each parameter of a term meets: a bit for each slot. specs: its parameters, where
/// a study says what they are.
template <class Hook, class T>
std::array<std::uint32_t, T::params.size()> slots_met(const Mounting& mounting,
                                                      const ParamSpec* specs = T::params.data()) {
  static_assert(T::params.size() <= 32);
  const SeenByTerms<Dependence> scene = scene_of_dependence(mounting);
  std::array<Dependence, T::params.size()> p;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Prior prior = specs[k].prior_si();
    p[k] = {prior.mean() + prior.sigma(), 1u << k};
  }
  std::array<Dependence, memory_of<T>() + 1> m;
  if constexpr (memory_of<T>() > 0) m.fill({0.5, 1u << T::memory_parameter});
  typename Hook::template Assembly<Dependence> added;
  Hook::template add<T, Dependence>(scene.still, p.data(), m.data(), added);
  std::array<std::uint32_t, T::params.size()> met{};
  for (std::size_t k = 0; k < met.size(); ++k)
    for (int s = 0; s < Hook::slots; ++s)
      if (Hook::template slot<Dependence>(added, s).on >> k & 1u) met[k] |= 1u << s;
  return met;
}

template <class Hook, class S, LanesAre lanes>
template <class T>
void SlotDerivatives<Hook, S, lanes>::add(const TermInfo& info, const Mounting& mounting,
                                          const std::vector<std::size_t>& states) {
  OneTerm t{info.first, static_cast<std::size_t>(info.first_memory), {}, &value<T>, &derivative<T>,
            &plain<T>};
  const ParamSpec* specs = &TermLibrary::specs[info.first];
  const auto met = slots_met<Hook, T>(mounting, specs);
  for (std::size_t k = 0; k < info.count; ++k) {
    const auto state = std::find(states.begin(), states.end(), info.first + k);
    if (state == states.end() || met[k] == 0) continue;
    bool affine = specs[k].kind == ParamKind::linear;
    if constexpr (memory_of<T>() > 0) affine = affine && k != T::memory_parameter;
    auto group = std::find_if(t.groups.begin(), t.groups.end(), [&](const Together& g) {
      return affine && g.affine && (g.met & met[k]) == 0;
    });
    if (group == t.groups.end()) group = t.groups.insert(group, Together{affine, {}, {}, 0});
    group->params.push_back(k);
    group->met |= met[k];
    for (std::uint32_t rest = met[k]; rest != 0; rest &= rest - 1) {
      const int slot = std::countr_zero(rest);
      group->slot_to_entry.emplace_back(slot, entries_.size());
      entries_.push_back({static_cast<std::size_t>(state - states.begin()), slot});
    }
  }
  if (t.groups.empty()) t.derivative = [](const SeenByTerms<S>&, const OneTerm&, S*) {};
  terms_.push_back(std::move(t));
}

}  // namespace drift
