// The chained derivatives of slots against dual numbers sent through the whole equation.
#include "core/estimate/linearizer.hpp"

#include <gtest/gtest.h>

#include "tests/support/own_terms.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::linearizer_test {
namespace {

using namespace drift::test;
using D = Dual<1>;

/// What is looked at: one interval of a test, linearised about an attitude off the nominal one.
struct Point {
  Timeline timeline = scene("slew12", CommandLaw::level, 600.0, 120.0);
  std::size_t interval = 0;
  Vec3 phi = Vec3(4e-3, -3e-3, 5e-3);
  Mat3 E_loop;

  explicit Point(std::size_t i) : interval(i) {
    E_loop << 0.0, 3e-4, -2e-4, 1e-4, 0.0, 2e-4, -4e-4, 1e-4, 0.0;
  }
  const Interval& at() const { return timeline.intervals[interval]; }
  const Node& node() const { return timeline.nodes[at().last_node()]; }
};

/// A model with the base terms and one more, and the states that an estimator may have of it.
struct Model {
  FilterSpec filter;
  Layout layout;
  Theta theta = random_theta(5);

  Model(Coupling coupling, std::initializer_list<std::size_t> terms) {
    filter = base_filter(coupling);
    if (coupling == Coupling::lambda) filter.active.set(closure_param);
    for (const std::size_t t : terms) {
      filter.active |= term_params(t);
      set_term(theta, t);
    }
    theta[closure_param] = coupling == Coupling::lambda ? 0.4 : 0.0;
    // Settings become states too: time constants, onsets, widths.
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (filter.active[i] && TermLibrary::specs[i].continuous())
        filter.priors[i] = normal(TermLibrary::specs[i].prior_si().mean(),
                                  0.1 * TermLibrary::specs[i].prior_si().mean());
    layout = make_layout(filter);
  }
};

/// The platform at a node as the whole equations have it, with one derivative.
struct Direct {
  Vec3T<D> omega_ip_p, acc, gimbal;
  Mat3T<D> R_lp;
};

/// psi: direction of attitude that is the variable, or -1; param: the parameter that is, or none.
Direct direct(const Point& p, const DriftModel& model, const Theta& theta,
              const MemoryPoint* memory, int psi, std::size_t variable) {
  std::array<D, TermLibrary::num_params> t;
  for (std::size_t k = 0; k < t.size(); ++k) t[k] = D(theta[static_cast<Eigen::Index>(k)]);
  if (psi < 0) t[variable].d[0] = 1.0;
  const Mat3 R = p.node().R_lr * rotation(p.phi);
  Direct out;
  out.R_lp = R.cast<D>();
  if (psi >= 0) {
    const Mat3 dR = skew<double>(Vec3::Unit(psi)) * R;
    for (int i = 0; i < 9; ++i) out.R_lp.data()[i].d[0] = dR.data()[i];
  }
  std::array<D, num_memory> m;
  for (std::size_t k = 0; memory && k < num_memory; ++k) m[k] = D(memory->value[k]);
  TermLibrary::for_each_memory(model.terms, [&]<class T>(const TermInfo& info) {
    if (psi < 0 && variable == info.first + T::memory_parameter)
      for (int k = info.first_memory; k < info.first_memory + info.memory; ++k)
        m[static_cast<std::size_t>(k)].d[0] = memory->derivative[static_cast<std::size_t>(k)];
  });
  Scene<D> seen(p.node().omega_ic_l, p.at().omega_cmd_p, model.mounting, out.R_lp);
  seen.look_around(TermLibrary::needs(model.terms), moment_at(p.timeline, p.at(), p.node().t),
                   out.R_lp, m.data());
  out.omega_ip_p = platform_rate(model, seen.in, t.data(), p.E_loop);
  for (int i = 0; i < 3; ++i)
    seen.around.omega_drift_p[i] = out.omega_ip_p[i].v - p.at().omega_cmd_p[i];
  out.acc = accelerometer_output(model, seen.in, t.data());
  out.gimbal = gimbal_output<D>(model, seen.in, out.R_lp, p.at().heading1, t.data());
  return out;
}

Vec3 derivative(const Vec3T<D>& v) {
  return {v[0].d[0], v[1].d[0], v[2].d[0]};
}

/// Both ways round off alike, each sum of a few dozen numbers: a relative 1e-12 of the largest
/// derivative of a column, or of what cancels (a difference of values of order one, for the
/// parameter taken to one: 1e-15 per unit of the parameter).
void expect_same(const Rows3& chained, Eigen::Index column, const Vec3& whole, double sigma,
                 std::string_view what) {
  const double bound = 1e-12 * whole.norm() + 4e-15 * sigma;
  EXPECT_LE((chained.col(column) - whole).norm(), bound) << what;
}

void expect_derivatives_of(const Model& m, const Point& p) {
  const DriftModel model = m.filter.model();
  MemoryPath memory(p.timeline, model);
  for (std::size_t i = 0; i <= p.interval; ++i) memory.advance(i, m.theta.data());
  const MemoryPoint* last =
      memory.active() ? &memory.points()[2 * (p.at().node_count() - 1)] : nullptr;
  Linearizer linearizer(model, m.layout, Readout{});
  linearizer.set_theta(m.theta);
  NodeJacobian j = linearizer.make();
  linearizer.evaluate({{{&p.node(), &p.at(), p.phi, last}}}, p.E_loop, &p.timeline, &j);
  const GimbalPrediction g = linearizer.gimbals(p.timeline, {&p.node(), &p.at(), p.phi, last});

  const Mat3 R_ip = p.node().R_il * (p.node().R_lr * rotation(p.phi));
  const auto whole = [&](int psi, std::size_t variable) {
    return direct(p, model, m.theta, last, psi, variable);
  };
  Mat3X A(3, 3), H(3, 3), H_gimbal(3, 3);
  for (int k = 0; k < 3; ++k) {
    const Direct d = whole(k, 0);
    A.col(k) = R_ip * derivative(d.omega_ip_p);
    H.col(k) = derivative(d.acc);
    H_gimbal.col(k) = derivative(d.gimbal);
  }
  const Mat3& R_il = p.node().R_il;
  EXPECT_LE((j.A * R_il - A).norm(), 1e-12 * A.norm() + 1e-19);
  EXPECT_LE((j.H * R_il - H).norm(), 1e-12 * H.norm());
  EXPECT_LE((g.H * R_il - H_gimbal).norm(), 1e-12 * H_gimbal.norm());
  const Direct here = whole(-1, 0);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(j.acc[a], here.acc[a].v, 4e-16);
    EXPECT_NEAR(angle_difference(g.angles[a], here.gimbal[a].v), 0.0, 2e-15);
  }
  for (std::size_t k = 0; k < m.layout.size(); ++k) {
    const std::size_t i = m.layout.params[k];
    const double sigma = m.layout.sigma[static_cast<Eigen::Index>(k)];
    const Direct d = whole(-1, i);
    const std::string_view key = TermLibrary::specs[i].key;
    if (k < m.layout.num_rate) {
      expect_same(j.B, static_cast<Eigen::Index>(k), sigma * R_ip * derivative(d.omega_ip_p), sigma,
                  key);
      continue;
    }
    const auto column = static_cast<Eigen::Index>(k - m.layout.num_rate);
    expect_same(j.H_par, column, sigma * derivative(d.acc), sigma, key);
    if (g.H_par.cols() > 0)
      expect_same(g.H_par, column, sigma * derivative(d.gimbal), sigma, key);
    else
      EXPECT_EQ(derivative(d.gimbal), Vec3::Zero()) << key;
  }
}

constexpr std::size_t in_a_slew = 9, in_a_dwell = 30;

TEST(Linearizer, ChainsTheSlotsOfEveryTermAsTheWholeEquationDoes) {
  for (const std::size_t at : {in_a_slew, in_a_dwell})
    for (const std::size_t t : visible_terms()) {
      SCOPED_TRACE(TermLibrary::terms[t].key);
      expect_derivatives_of(Model(coupling_for(t), {t}), Point(at));
    }
}

/// Output and spin axes exchanged, of one gyro and one accelerometer each way.
TEST(Linearizer, ChainsThemForInstrumentsThatAreMountedOtherwise) {
  Mounting otherwise;
  for (Triads* triads : {&otherwise.gyro, &otherwise.accelerometer}) {
    triads->second[0] = {2, 1.0};  // x z -y
    triads->third[0] = {1, -1.0};
    triads->second[2] = {1, -1.0};  // z -y x
    triads->third[2] = {0, 1.0};
  }
  for (const std::size_t at : {in_a_slew, in_a_dwell})
    for (const std::size_t t : visible_terms()) {
      SCOPED_TRACE(TermLibrary::terms[t].key);
      Model m(coupling_for(t), {t});
      m.filter.mounting = otherwise;
      expect_derivatives_of(m, Point(at));
    }
}

TEST(Linearizer, ChainsThemForTermsThatAStudyBrings) {
  const OwnTermsHeld held(own_terms_of_every_kind());
  ASSERT_EQ(TermLibrary::terms.size(), TermLibrary::num_terms);
  for (const std::size_t at : {in_a_slew, in_a_dwell})
    for (std::size_t t = TermLibrary::num_known; t < TermLibrary::num_terms; ++t) {
      SCOPED_TRACE(TermLibrary::terms[t].key);
      expect_derivatives_of(Model(Coupling::eq6, {t}), Point(at));
    }
}

TEST(Linearizer, ChainsThemForEveryCoupling) {
  for (const CouplingFacts& c : couplings)
    for (const std::size_t at : {in_a_slew, in_a_dwell}) {
      if (c.value == Coupling::servo) continue;  // integrated, in no filter
      SCOPED_TRACE(c.name);
      expect_derivatives_of(Model(c.value, {}), Point(at));
    }
}

TEST(Linearizer, ChainsThemWithEveryTermAtOnce) {
  Model all(Coupling::lambda, {});
  for (const std::size_t t : visible_terms()) {
    // Terms of a case that turns never meet those that offset a platform from its gyros.
    if (TermLibrary::terms[t].needs.turning) continue;
    all.filter.active |= term_params(t);
    set_term(all.theta, t);
  }
  all.theta[closure_param] = 0.4;
  all.layout = make_layout(all.filter);
  for (const std::size_t at : {in_a_slew, in_a_dwell}) expect_derivatives_of(all, Point(at));
}

TEST(SlotDerivatives, ThreeAxesOfAGroupShareAnEvaluation) {
  // 13 groups of the base rates act by one slot each, eta and xi by one of E: 39 entries.
  const Layout layout = make_layout(base_spec(Coupling::eq5));
  std::vector<std::size_t> states(layout.params.begin(), layout.params.begin() + 39);
  const SlotDerivatives<RatesHook, double> rates(base_spec(Coupling::eq5).model().terms, Mounting(),
                                                 states);
  EXPECT_EQ(rates.entries().size(), 39u);
}

TEST(SlotDerivatives, AParameterThatMeetsAllAxesIsFoundToDoSo) {
  const auto met = slots_met<OffsetHook, terms::HangOff>(Mounting());
  EXPECT_EQ(met[0], 0b111u);  // about a gimbal's axis
  EXPECT_EQ(met[3], 0b110u);  // x of a vector crossed with the specific force
}

}  // namespace
}  // namespace drift::linearizer_test
