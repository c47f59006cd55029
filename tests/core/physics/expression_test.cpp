// The language of own terms: what an equation means, what is wrong with one, what it costs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/physics/expression/compile.hpp"
#include "core/physics/expression/degree.hpp"
#include "core/physics/expression/evaluate.hpp"
#include "core/physics/expression/kelvins.hpp"
#include "core/physics/expression/parse.hpp"
#include "core/physics/expression/units_of.hpp"

namespace drift::expression_test {
namespace {

using namespace drift;

const std::vector<std::string> inputs{"x", "y"}, params{"A", "B", "P"};
const double at[] = {0.7, -1.3}, value_of[] = {2.0, -0.5, 3.0};

OrMistake<EquationTree> read(std::string_view text) {
  return parse_equation(text, {inputs, params});
}

template <class S>
S evaluated(const EquationProgram& program, const S* x, const S* p) {
  return evaluate_program(program, p, [&](int i) { return x[i]; });
}

double result(std::string_view text) {
  const EquationProgram program =
      std::get<EquationProgram>(compile_tree(std::get<EquationTree>(read(text))));
  return evaluated(program, at, value_of);
}

TEST(Expression, MeansWhatMathematicsMeans) {
  const double x = at[0], y = at[1], A = value_of[0], B = value_of[1], P = value_of[2];
  const std::pair<const char*, double> cases[] = {
      {"1 + 2*3", 7.0},
      {"(1 + 2)*3", 9.0},
      {"2 - 3 - 4", -5.0},
      {"16/4/2", 2.0},
      {"-2^2", -4.0},
      {"(-2)^2", 4.0},
      {"2^3^2", 512.0},
      {"2^-1", 0.5},
      {"2*-3", -6.0},
      {"+x", x},
      {"--x", x},
      {".5 + 1e-1 + 1E1", 10.6},
      {"x^3", x * x * x},
      {"y^-2", 1.0 / (y * y)},
      {"x^0", 1.0},
      {"x^2.5", std::pow(x, 2.5)},
      {"pow(x, A)", std::pow(x, A)},
      {"pow(y, 3)", y * y * y},
      {"0^1.5", 0.0},
      {"A*sin(2*pi*x/P)", A * std::sin(2.0 * std::numbers::pi * x / P)},
      {"cos(x) + tan(y)", std::cos(x) + std::tan(y)},
      {"exp(B) * log(P)", std::exp(B) * std::log(P)},
      {"sqrt(P) - abs(y)", std::sqrt(P) - std::abs(y)},
      {"tanh(x) / atan(y)", std::tanh(x) / std::atan(y)},
      {"step(x) + 10*step(y) + 100*step(0)", 1.0},
      {"sign(x) + 10*sign(y) + 100*sign(0)", -9.0},
      {"min(x, y) + 10*max(x, y)", y + 10.0 * x},
  };
  // x^y is exp(y log x): as many roundings more as y log x is large, at most 7.
  for (const auto& [text, expected] : cases)
    EXPECT_NEAR(result(text), expected, 2e-15 * std::abs(expected)) << text;
}

TEST(Expression, DerivativesAreThoseByDifferences) {
  using D = Dual<2>;
  for (const char* text :
       {"A*sin(x*y) + cos(x)/y", "tan(x) - exp(B*x)*tanh(y)", "log(P + x) * sqrt(P + x*y)",
        "abs(y)^3 + y^-2 + P^x", "atan(x/y)*atan(P*x)", "min(x, y)*max(x*x, y) + x*step(x - 0.1)",
        "pow(P + y, x) * sign(y)", "-x^5 - (x - y)/(x + P)"}) {
    const EquationProgram program =
        std::get<EquationProgram>(compile_tree(std::get<EquationTree>(read(text))));
    const D x[] = {D::variable(at[0], 0), D::variable(at[1], 1)};
    const D p[] = {value_of[0], value_of[1], value_of[2]};
    const D y = evaluated(program, x, p);
    EXPECT_EQ(y.v, evaluated(program, at, value_of)) << text;
    for (int k = 0; k < 2; ++k) {
      constexpr double h = 1e-5;  // truncation h^2/6 f''' and rounding 1e-16 f/h: both below 1e-9
      double up[] = {at[0], at[1]}, down[] = {at[0], at[1]};
      up[k] += h;
      down[k] -= h;
      const double slope =
          (evaluated(program, up, value_of) - evaluated(program, down, value_of)) / (2.0 * h);
      EXPECT_NEAR(y.d[k], slope, 2e-8 * (1.0 + std::abs(slope))) << text << " by " << k;
    }
  }
}

/// A root is a power: where what stands below it is zero, the slope is infinite in what it follows,
/// and none in what it does not.
TEST(Expression, ARootAndThePowerOfAHalfHaveTheSameSlopeAtZero) {
  using D = Dual<2>;
  const auto slopes = [](const char* text, double x) {
    const EquationProgram program =
        std::get<EquationProgram>(compile_tree(std::get<EquationTree>(read(text))));
    const D in[] = {D::variable(x, 0), D::variable(0.0, 1)};
    const D p[] = {value_of[0], value_of[1], value_of[2]};
    const D value = evaluated(program, in, p);
    EXPECT_EQ(value.v, 0.0) << text;
    return std::pair{value.d[0], value.d[1]};
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* text : {"sqrt(x)", "x^0.5", "pow(x, 1/2)"})
    EXPECT_EQ(slopes(text, 0.0), (std::pair{infinity, 0.0})) << text;
  for (const char* text : {"sqrt(max(x, 0))", "max(x, 0)^0.5", "max(x, 0)^0.1"})
    EXPECT_EQ(slopes(text, -1.0), (std::pair{0.0, 0.0})) << text;
  EXPECT_EQ(slopes("x^1.5", 0.0), (std::pair{0.0, 0.0}));
  EXPECT_EQ(slopes("pow(x, P - 2)", 0.0), (std::pair{1.0, 0.0})) << "to the power of one";
}

TEST(Expression, DependenceSeesEveryParameterOfAPart) {
  const EquationProgram program = std::get<EquationProgram>(
      compile_tree(std::get<EquationTree>(read("min(A*x, B) + step(P - x) * y"))));
  const Dependence x[] = {0.7, -1.3}, p[] = {{2.0, 1u}, {-0.5, 2u}, {3.0, 4u}};
  EXPECT_EQ(evaluated(program, x, p).on, 7u);
}

TEST(Expression, ConstantsAreWorkedOutBefore) {
  const EquationProgram program =
      std::get<EquationProgram>(compile_tree(std::get<EquationTree>(read("2*pi/(3 + 4)*x"))));
  EXPECT_EQ(program.size, 3u);  // a number, x, times
}

TEST(Expression, MistakesAreWhereTheyAre) {
  const std::tuple<const char*, std::size_t, const char*> cases[] = {
      {"A * sine(x)", 4, "unknown name 'sine'"},
      {"A * x + ", 8, "ends too early"},
      {"", 0, "ends too early"},
      {"A * (x + y", 10, "lacks a ')'"},
      {"A * x)", 5, "goes on with ')'"},
      {"2 x", 2, "goes on with 'x'"},
      {"A * , x", 4, "has ',' where a value is meant"},
      {"A ** x", 2, "has '**'"},
      {"A * sin x", 4, "calls sin with other than 1 value"},
      {"min(x)", 0, "calls min with other than 2 values"},
      {"sin(x, y)", 0, "calls sin with other than 1 value"},
      {"x + 1e999", 4, "number that cannot be read"},
      {"A $ x", 2, "goes on with '$'"}};
  for (const auto& [text, place, what] : cases) {
    const auto parsed = read(text);
    const EquationMistake* mistake = std::get_if<EquationMistake>(&parsed);
    ASSERT_NE(mistake, nullptr) << text;
    EXPECT_EQ(mistake->at, place) << text;
    EXPECT_NE(mistake->what.find(what), std::string::npos) << text << ": " << mistake->what;
    EXPECT_FALSE(mistake->expected.empty() || mistake->fix.empty()) << text;
  }
}

TEST(Expression, WhatDoesNotFitIsRefused) {
  std::string sum = "x", deep = "x", brackets;
  for (int i = 0; i < 32; ++i) sum += "+y";
  EXPECT_TRUE(
      std::holds_alternative<EquationMistake>(compile_tree(std::get<EquationTree>(read(sum)))));
  sum.resize(sum.size() - 2);
  EXPECT_EQ(std::get<EquationProgram>(compile_tree(std::get<EquationTree>(read(sum)))).size, 63u);
  for (int i = 0; i < 16; ++i) deep = "x+(" + deep + ")";
  EXPECT_TRUE(
      std::holds_alternative<EquationMistake>(compile_tree(std::get<EquationTree>(read(deep)))));
  for (int i = 0; i < 100000; ++i) brackets += "(";
  EXPECT_TRUE(std::holds_alternative<EquationMistake>(read(brackets)));
}

TEST(Expression, AmplitudesStandInEverySummandOnce) {
  const std::vector<bool> amplitude{true, true, false};
  for (const char* right : {"A*x", "A*x + B*sin(y)/P", "-(A - B*y)*step(x)", "A", "(A + B)/P^2"})
    EXPECT_FALSE(mistake_of_degree(std::get<EquationTree>(read(right)), amplitude, params))
        << right;
  const std::tuple<const char*, std::size_t, const char*> wrong[] = {
      {"A*x + y", 4, "adds what does not vanish with 'A'"},
      {"x/A", 1, "divides by 'A'"},
      {"A*B", 1, "multiplies 'A' by 'B'"},
      {"A^2", 1, "has 'A' inside a function or a power"},
      {"x*sin(B)", 2, "has 'B' inside a function or a power"},
      {"max(A, B)", 0, "has 'A' inside a function or a power"}};
  for (const auto& [text, place, what] : wrong) {
    const auto mistake = mistake_of_degree(std::get<EquationTree>(read(text)), amplitude, params);
    ASSERT_TRUE(mistake.has_value()) << text;
    EXPECT_EQ(mistake->at, place) << text;
    EXPECT_EQ(mistake->what, what) << text;
  }
  EXPECT_FALSE(
      mistake_of_degree(std::get<EquationTree>(read("x^A")), {false, false, false}, params));
}

/// y: a column of the recording, P: 294.15 K.
TEST(Expression, ATemperatureInKelvinsStandsBesideNoColumn) {
  std::vector<std::optional<KelvinParameter>> kelvins(params.size());
  kelvins[2] = {"P", 294.15};
  const auto mistake = [&](const char* text) {
    return mistake_of_kelvins(std::get<EquationTree>(read(text)), 1, kelvins);
  };
  for (const char* right : {"A*step(x - P)", "A*P*y", "A*step(y - B)", "A*step(y/B - y/A - P)",
                            "A*(y - y - P)", "A*max(x, P)", "A*step(y)*step(x - P)"})
    EXPECT_FALSE(mistake(right)) << right;
  const std::pair<const char*, std::size_t> wrong[] = {
      {"A*step(y - P)", 11}, {"P - y", 0}, {"A*max(y, P)", 9}, {"A*-(y - (B + P))", 13}};
  for (const auto& [text, place] : wrong) {
    const auto m = mistake(text);
    ASSERT_TRUE(m) << text;
    EXPECT_EQ(m->at, place) << text;
    EXPECT_NE(m->fix.find("294.15 K is 21 degC as a temperature"), std::string::npos) << m->fix;
  }
}

/// x: a time, y: a specific force, A: a rate, B: a rate per g, P: a time.
OrMistake<MaybeDimension> measured(const char* text) {
  // clang 14 crashes over lists of them.
  std::vector<MaybeDimension> of_inputs, of_params;
  for (const Unit& unit : {"s"_unit, "g"_unit}) of_inputs.emplace_back(unit.dim);
  for (const Unit& unit : {"deg/h"_unit, "deg/h/g"_unit, "min"_unit})
    of_params.emplace_back(unit.dim);
  return dimension_of(std::get<EquationTree>(read(text)), of_inputs, of_params);
}

TEST(Expression, UnitsAreCheckedWhereNamesMeet) {
  const MaybeDimension rate = "rad/s"_unit.dim, anything;
  for (const char* text : {"A", "B*y", "A*sin(pi*x/P)", "A + B*y", "B*max(y, -y)", "A*tanh(x/P)",
                           "A*sqrt(x^2/P^2)", "A*(x/P)^1.5", "A*step(abs(y) - 0.8)", "-A*x/P"})
    EXPECT_EQ(std::get<MaybeDimension>(measured(text)), rate) << text;
  for (const char* text : {"A*x/3600", "2*B", "A*atan(x/P)", "A*(1 + abs(y))"})
    EXPECT_EQ(std::get<MaybeDimension>(measured(text)), anything) << text;
  const std::pair<const char*, const char*> wrong[] = {{"A + B", "puts together"},
                                                       {"A*sin(x)", "takes a function of time"},
                                                       {"min(x, y)", "puts together"},
                                                       {"P^x", "has the exponent time"}};
  for (const auto& [text, what] : wrong) {
    const auto m = measured(text);
    ASSERT_TRUE(std::holds_alternative<EquationMistake>(m)) << text;
    EXPECT_NE(std::get<EquationMistake>(m).what.find(what), std::string::npos)
        << std::get<EquationMistake>(m).what;
  }
  EXPECT_EQ(dimension_in_words("deg/h/g^2"_unit.dim), "angle time^-1 g^-2");
  EXPECT_EQ(dimension_in_words(Dimension{}), "a plain number");
}

}  // namespace
}  // namespace drift::expression_test
