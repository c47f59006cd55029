#include "analysis/forms/form.hpp"

#include <cmath>
#include <numbers>

namespace drift::forms {
namespace {

/// cos and sin of an angle.
MatX both(const VecX& angle) {
  MatX out(angle.size(), 2);
  out << angle.array().cos().matrix(), angle.array().sin().matrix();
  return out;
}

VecX step(const VecX& x) {
  return (x.array() > 0.0).cast<double>();
}

}  // namespace

MatX columns_of(const AttitudePart& part, const Instants& at) {
  using Kind = AttitudePart::Kind;
  const auto force = [&]() -> const VecX& { return at.force[part.of.front()]; };
  switch (part.kind) {
    case Kind::product: {
      VecX product = VecX::Ones(at.size());
      for (const std::size_t q : part.of) product.array() *= at.quantities[q].value.array();
      return product;
    }
    case Kind::saturation:
      return (force().array() / part.setting).tanh().matrix();
    case Kind::harmonic:
      return both(part.order * at.gimbal[part.of.front()]);
    case Kind::above:
      return step(force().array() - part.setting);
    case Kind::below:
      return step(part.setting - force().array());
    case Kind::beyond:
      return step(force().array().abs() - part.setting);
    case Kind::one:
      break;
  }
  return VecX::Ones(at.size());
}

MatX columns_of(const TimePart& part, const Instants& at) {
  using Kind = TimePart::Kind;
  switch (part.kind) {
    case Kind::power:
      return (at.t.array() / unit::hour.to_si).pow(part.order).matrix();
    case Kind::decay:
      return (-at.t.array() / part.setting).exp().matrix();
    case Kind::decay_in_position:
      return (-at.t_position.array() / part.setting).exp().matrix();
    case Kind::harmonic:
      return both(2.0 * std::numbers::pi / part.setting * at.t);
    case Kind::onset:
      return step(at.t.array() - part.setting);
    case Kind::window:
      return step(at.t.array() - part.setting).cwiseProduct(step(part.end - at.t.array()));
    case Kind::one:
      break;
  }
  return VecX::Ones(at.size());
}

MatX columns_of(const Form& form, const Instants& at) {
  const MatX where = columns_of(form.where, at), when = columns_of(form.when, at);
  MatX out(at.size(), where.cols() * when.cols());
  for (Eigen::Index i = 0; i < where.cols(); ++i)
    for (Eigen::Index k = 0; k < when.cols(); ++k)
      out.col(i * when.cols() + k) = where.col(i).cwiseProduct(when.col(k));
  return out;
}

double* moved_setting(Form& form) {
  using Kind = TimePart::Kind;
  if (form.when.kind == Kind::decay || form.when.kind == Kind::decay_in_position ||
      form.when.kind == Kind::harmonic)
    return &form.when.setting;
  return form.where.kind == AttitudePart::Kind::saturation ? &form.where.setting : nullptr;
}

double* sigma_of_moved(Form& form) {
  const double* setting = moved_setting(form);
  return setting == nullptr              ? nullptr
         : setting == &form.when.setting ? &form.when.sigma
                                         : &form.where.sigma;
}

}  // namespace drift::forms
