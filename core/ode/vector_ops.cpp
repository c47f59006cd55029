#include "core/ode/vector_ops.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drift::detail {
namespace {

using Index = sunindextype;

Index size(N_Vector v) {
  return NV_LENGTH_S(v);
}
double* data(N_Vector v) {
  return NV_DATA_S(v);
}

/// Sum of term(0..n-1) in four interleaved partial sums: fast, and in a fixed order.
template <class Term>
double sum(Index n, Term term) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
  Index i = 0;
  for (; i + 4 <= n; i += 4) {
    s0 += term(i);
    s1 += term(i + 1);
    s2 += term(i + 2);
    s3 += term(i + 3);
  }
  for (; i < n; ++i) s0 += term(i);
  return (s0 + s1) + (s2 + s3);
}

/// z_i = f(i) for all i.
template <class F>
void fill(N_Vector z, F f) {
  double* out = data(z);
  for (Index i = 0, n = size(z); i < n; ++i) out[i] = f(i);
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const double *xd = data(x), *yd = data(y);
  fill(z, [=](Index i) { return a * xd[i] + b * yd[i]; });
}
void constant(double c, N_Vector z) {
  fill(z, [=](Index) { return c; });
}
void product(N_Vector x, N_Vector y, N_Vector z) {
  const double *xd = data(x), *yd = data(y);
  fill(z, [=](Index i) { return xd[i] * yd[i]; });
}
void quotient(N_Vector x, N_Vector y, N_Vector z) {
  const double *xd = data(x), *yd = data(y);
  fill(z, [=](Index i) { return xd[i] / yd[i]; });
}
void scale(double c, N_Vector x, N_Vector z) {
  const double* xd = data(x);
  fill(z, [=](Index i) { return c * xd[i]; });
}
void absolute(N_Vector x, N_Vector z) {
  const double* xd = data(x);
  fill(z, [=](Index i) { return std::abs(xd[i]); });
}
void inverse(N_Vector x, N_Vector z) {
  const double* xd = data(x);
  fill(z, [=](Index i) { return 1.0 / xd[i]; });
}
void add_constant(N_Vector x, double b, N_Vector z) {
  const double* xd = data(x);
  fill(z, [=](Index i) { return xd[i] + b; });
}

double dot(N_Vector x, N_Vector y) {
  const double *xd = data(x), *yd = data(y);
  return sum(size(x), [=](Index i) { return xd[i] * yd[i]; });
}
double max_norm(N_Vector x) {
  const double* xd = data(x);
  double m = 0.0;
  for (Index i = 0, n = size(x); i < n; ++i) m = std::max(m, std::abs(xd[i]));
  return m;
}
double minimum(N_Vector x) {
  const double* xd = data(x);
  double m = std::numeric_limits<double>::max();
  for (Index i = 0, n = size(x); i < n; ++i) m = std::min(m, xd[i]);
  return m;
}
double l1_norm(N_Vector x) {
  const double* xd = data(x);
  return sum(size(x), [=](Index i) { return std::abs(xd[i]); });
}
double weighted_square_sum(N_Vector x, N_Vector w) {
  const double *xd = data(x), *wd = data(w);
  return sum(size(x), [=](Index i) { return (xd[i] * wd[i]) * (xd[i] * wd[i]); });
}
double weighted_square_sum_mask(N_Vector x, N_Vector w, N_Vector id) {
  const double *xd = data(x), *wd = data(w), *on = data(id);
  return sum(size(x),
             [=](Index i) { return on[i] > 0.0 ? (xd[i] * wd[i]) * (xd[i] * wd[i]) : 0.0; });
}
double wl2_norm(N_Vector x, N_Vector w) {
  return std::sqrt(weighted_square_sum(x, w));
}
double wrms_norm(N_Vector x, N_Vector w) {
  return std::sqrt(weighted_square_sum(x, w) / static_cast<double>(size(x)));
}
double wrms_norm_mask(N_Vector x, N_Vector w, N_Vector id) {
  return std::sqrt(weighted_square_sum_mask(x, w, id) / static_cast<double>(size(x)));
}

/// z = sum_j c_j x_j. CVODE passes z among the x_j, so each component is finished before the next.
int linear_combination(int m, double* c, N_Vector* x, N_Vector z) {
  double* zd = data(z);
  const Index n = size(z);
  for (Index i = 0; i < n; ++i) {
    double s = 0.0;
    for (int j = 0; j < m; ++j) s += c[j] * data(x[j])[i];
    zd[i] = s;
  }
  return 0;
}
/// z_j = a_j x + y_j.
int scale_add_multi(int m, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for (int j = 0; j < m; ++j) linear_sum(a[j], x, 1.0, y[j], z[j]);
  return 0;
}
int dot_multi(int m, N_Vector x, N_Vector* y, double* result) {
  for (int j = 0; j < m; ++j) result[j] = dot(x, y[j]);
  return 0;
}

int linear_sum_array(int m, double a, N_Vector* x, double b, N_Vector* y, N_Vector* z) {
  for (int j = 0; j < m; ++j) linear_sum(a, x[j], b, y[j], z[j]);
  return 0;
}
int scale_array(int m, double* c, N_Vector* x, N_Vector* z) {
  for (int j = 0; j < m; ++j) scale(c[j], x[j], z[j]);
  return 0;
}
int constant_array(int m, double c, N_Vector* z) {
  for (int j = 0; j < m; ++j) constant(c, z[j]);
  return 0;
}
int wrms_norm_array(int m, N_Vector* x, N_Vector* w, double* norms) {
  for (int j = 0; j < m; ++j) norms[j] = wrms_norm(x[j], w[j]);
  return 0;
}
/// Z[j][k] = a_j x[k] + Y[j][k] for k < vectors, j < sums.
int scale_add_multi_array(int vectors, int sums, double* a, N_Vector* x, N_Vector** Y,
                          N_Vector** Z) {
  for (int j = 0; j < sums; ++j)
    for (int k = 0; k < vectors; ++k) linear_sum(a[j], x[k], 1.0, Y[j][k], Z[j][k]);
  return 0;
}
/// z[k] = sum_j c_j X[j][k] for k < vectors.
int linear_combination_array(int vectors, int sums, double* c, N_Vector** X, N_Vector* z) {
  for (int k = 0; k < vectors; ++k) {
    double* zd = data(z[k]);
    const Index n = size(z[k]);
    for (Index i = 0; i < n; ++i) {
      double s = 0.0;
      for (int j = 0; j < sums; ++j) s += c[j] * data(X[j][k])[i];
      zd[i] = s;
    }
  }
  return 0;
}

VectorPtr with_own_operations(N_Vector v) {
  check_setup(v, "N_Vector");
  auto& ops = *v->ops;
  ops.nvlinearsum = linear_sum;
  ops.nvconst = constant;
  ops.nvprod = product;
  ops.nvdiv = quotient;
  ops.nvscale = scale;
  ops.nvabs = absolute;
  ops.nvinv = inverse;
  ops.nvaddconst = add_constant;
  ops.nvdotprod = ops.nvdotprodlocal = dot;
  ops.nvmaxnorm = ops.nvmaxnormlocal = max_norm;
  ops.nvmin = ops.nvminlocal = minimum;
  ops.nvl1norm = ops.nvl1normlocal = l1_norm;
  ops.nvwl2norm = wl2_norm;
  ops.nvwrmsnorm = wrms_norm;
  ops.nvwrmsnormmask = wrms_norm_mask;
  ops.nvwsqrsumlocal = weighted_square_sum;
  ops.nvwsqrsummasklocal = weighted_square_sum_mask;
  ops.nvlinearcombination = linear_combination;
  ops.nvscaleaddmulti = scale_add_multi;
  ops.nvdotprodmulti = dot_multi;
  ops.nvlinearsumvectorarray = linear_sum_array;
  ops.nvscalevectorarray = scale_array;
  ops.nvconstvectorarray = constant_array;
  ops.nvwrmsnormvectorarray = wrms_norm_array;
  ops.nvscaleaddmultivectorarray = scale_add_multi_array;
  ops.nvlinearcombinationvectorarray = linear_combination_array;
  return VectorPtr(v);
}

}  // namespace

VectorPtr make_vector(int n, _SUNContext* context) {
  VectorPtr v = with_own_operations(N_VNew_Serial(n, context));
  constant(0.0, v.get());
  return v;
}

}  // namespace drift::detail
