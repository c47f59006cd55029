// [[term]] of a study file: what is read, and what is said of what is wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/config/load.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/term_library.hpp"
#include "mc/study/declared_keys.hpp"
#include "tests/mc/study/study_file.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::own_terms_config_test {
namespace {

using namespace drift::test;

const std::string head = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "rumble"]
[[filter]]
name = "with"
coupling = "eq5"
terms = ["fixed_drift", "rumble"]
)toml";

const std::string rumble = R"toml([[term]]
key = "rumble"
title = "bearing rumble of the inner gimbal"
acts_on = "rate.y"
equation = "A * sin(2*pi*t/P) * step(abs(f_z) - 0.8)"
parameters = { A = { unit = "deg/h", prior = 0.01 }, P = { unit = "min", value = 37 } }
)toml";

/// The one mistake of a study with this [[term]].
std::string mistake(const std::string& term) {
  const auto all = mistakes(head + term);
  EXPECT_EQ(all.size(), 1u) << term << (all.empty() ? "" : "\n" + all.back());
  return all.empty() ? "" : all.front();
}

void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nin: " << text;
}

std::size_t param(std::string_view key) {
  return TermLibrary::find(key).value();
}

/// The library is everybody's: it is left as it was.
class OwnTermsConfig : public testing::Test {
  KeptOwnTerms kept_;
};

TEST_F(OwnTermsConfig, TheTermOfTheInterfaceIsReadAsItIsWritten) {
  const mc::Study study = read_text(head + rumble);
  const TermInfo& term = TermLibrary::owner(param("rumble_A"));
  EXPECT_EQ(term.key, "rumble");
  EXPECT_EQ(term.title, "bearing rumble of the inner gimbal");
  EXPECT_EQ(term.equation, "w_ip,y += A * sin(2*pi*t/P) * step(abs(f_z) - 0.8)");
  EXPECT_TRUE(term.in_rates && !term.in_readout && !term.in_gimbals && term.needs.clock);
  EXPECT_FALSE(term.needs.gimbals || term.needs.covariates != 0);
  const ParamSpec &A = TermLibrary::specs[param("rumble_A")],
                  &P = TermLibrary::specs[param("rumble_P")];
  EXPECT_EQ(A.kind, ParamKind::linear);
  EXPECT_EQ(A.prior, normal(0.0, 0.01));
  EXPECT_EQ(A.unit.symbol.view(), "deg/h");
  EXPECT_EQ(P.kind, ParamKind::nonlinear);
  EXPECT_EQ(P.prior, fixed(37.0));
  for (const ModelSpec& spec : {ModelSpec(study.truth), ModelSpec(study.filters[0])}) {
    EXPECT_TRUE(spec.active[param("rumble_A")] && spec.active[param("rumble_P")]);
    EXPECT_DOUBLE_EQ(spec.priors[param("rumble_P")].a, 37.0 * 60.0);
  }
}

TEST_F(OwnTermsConfig, NumbersMayHaveUnitsAndPriorsDistributions) {
  read_text(head + R"toml([[term]]
key = "rumble"
acts_on = "drift.z"
equation = "(A + B + C)*(t/P)^e"
[term.parameters]
A = { unit = "deg/h", prior = "0.1 meru" }
B = { unit = "deg/h", prior = { uniform = [-1, "2 deg/h"] } }
C = { unit = "deg/h", prior = { normal = ["0.1 deg/h", 0.2] } }
P = { unit = "min", value = "2 h", prior = 5, grid = [100, "2 h", 130] }
e = { value = 2 }
)toml");
  const auto spec = [](const char* key) { return TermLibrary::specs[param(key)]; };
  EXPECT_NEAR(spec("rumble_A").prior.b, 0.1 * 1e-3 * detail::earth_rate * 3600.0 / detail::deg,
              1e-15);
  EXPECT_EQ(spec("rumble_B").prior, uniform(-1.0, 2.0));
  EXPECT_EQ(spec("rumble_C").prior, normal(0.1, 0.2));
  EXPECT_EQ(spec("rumble_P").prior, normal(120.0, 5.0));
  EXPECT_EQ(spec("rumble_P").grid.size, 3u);
  EXPECT_EQ(spec("rumble_P").grid.values[1], 120.0);
  EXPECT_EQ(spec("rumble_e").kind, ParamKind::nonlinear);
}

TEST_F(OwnTermsConfig, ParametersOfTheTermAreThoseOfAnyOther) {
  const mc::Study study = read_text(head + rumble +
                                    "[truth.parameters]\nrumble_A = \"0.03 deg/h\"\nrumble_P = "
                                    "{ normal = [\"30 min\", \"1 min\"] }\n[sweep]\n"
                                    "\"truth.parameters.rumble_A\" = [\"0.01 deg/h\"]\n");
  EXPECT_EQ(study.truth.priors[param("rumble_A")].kind, Prior::Kind::fixed);
  EXPECT_DOUBLE_EQ(study.truth.priors[param("rumble_P")].a, 1800.0);
  const mc::Study again = read_text(study.text);
  EXPECT_EQ(again.text, study.text);
  EXPECT_EQ(TermLibrary::terms.size(), TermLibrary::num_known + 1);
}

TEST_F(OwnTermsConfig, TheNextStudyBringsItsOwn) {
  read_text(head + rumble);
  EXPECT_TRUE(TermLibrary::find_term("rumble").has_value());
  mistakes(full_study);
  EXPECT_FALSE(TermLibrary::find_term("rumble").has_value());
  read_text(head + rumble);
  mc::declared_keys(config::parse_document("[plan]\n", "study"));  // looks at a study, reads none
  EXPECT_TRUE(TermLibrary::find_term("rumble").has_value());
  EXPECT_FALSE(mistakes(head).empty());  // "rumble" is unknown
}

TEST_F(OwnTermsConfig, ColumnsOfTheRecordingAreKnownByTheirNames) {
  const mc::Study study =
      read_text(head +
                own_term("rumble", "drift.x", "A*pressure + B*pressure*humidity",
                         "A = { unit = 'deg/h', prior = 1 }, B = { unit = 'deg/h', prior = 1 }") +
                own_term("other", "drift.y", "A*humidity", "A = { unit = 'deg/h', prior = 1 }"));
  EXPECT_EQ(own_terms().covariates, (std::vector<std::string>{"pressure", "humidity"}));
  EXPECT_EQ(study.recording.of_terms, own_terms().covariates);
  EXPECT_EQ(TermLibrary::owner(param("rumble_A")).needs.covariates,
            further_column(0) | further_column(1));
  EXPECT_EQ(TermLibrary::owner(param("other_A")).needs.covariates, further_column(1));
}

TEST_F(OwnTermsConfig, AColumnMayBeCalledLikeWhatAnEquationKnowsWithAWordMore) {
  const auto with = [](const std::string& name) {
    return own_term("rumble", "drift.x", "A*" + name, "A = { unit = 'deg/h', prior = 1 }");
  };
  for (const std::string name : {"oil_temperature", "temperature_2", "temperature_raw",
                                 "gimbal_outer_raw", "log_oil", "A_oil", "f_x2"}) {
    read_text(head + with(name));
    EXPECT_EQ(own_terms().covariates, std::vector<std::string>{name});
  }
  for (const auto& [typed, meant] :
       {std::pair{"temprature", "temperature"}, std::pair{"gimbal_oter", "gimbal_outer"},
        std::pair{"T", "t"}}) {
    const std::string said = mistake(with(typed));
    expect_says(said, std::string("has the unknown name '") + typed + "'");
    expect_says(said, std::string("Did you mean '") + meant + "'?");
    expect_says(said, std::string("columns = { another_name = \"") + typed + " [its unit]\" }");
  }
  expect_says(mistake(with("foo(t)")), "has the unknown name 'foo'");
}

TEST_F(OwnTermsConfig, ATemperatureIsComparedWithAColumnInDegreesCelsius) {
  const auto with = [](const std::string& equation, const std::string& C) {
    return own_term("rumble", "drift.y", equation,
                    "A = { unit = 'deg/h', prior = 1 }, C = { " + C + " }");
  };
  const std::string warm = "unit = 'degC', value = 21", kelvin = "unit = 'K', value = 294.15";
  read_text(head + with("A*step(oil - C)", warm));
  read_text(head + with("A*step(oil - box - C)", kelvin));
  read_text(head + with("A*step(temperature - C)", kelvin));
  const std::string said = mistake(with("A*step(oil - C)", kelvin));
  expect_says(said, "puts 'C', in K, beside a column of the recording");
  expect_says(said, "294.15 K is 21 degC as a temperature");
  expect_says(mistake(with("A*step(oil - C)", "unit = 'degC', value = '294.15 K'")),
              "Write \"21 degC\" if it is a temperature");
  read_text(head + with("A*step(oil - C)", warm + ", prior = '2 K'"));  // a sigma
  EXPECT_EQ(TermLibrary::specs[param("rumble_C")].prior, normal(21.0, 2.0));
}

TEST_F(OwnTermsConfig, AMistakeInAnEquationIsShownInItsPlace) {
  const std::string text = mistake(
      "[[term]]\nkey = \"rumble\"\nacts_on = \"rate.y\"\nequation = \"A * sinn(t/P)\"\nparameters "
      "= "
      "{ A = { unit = \"deg/h\", prior = 1 }, P = { unit = \"min\", value = 37 } }\n");
  EXPECT_TRUE(
      text.starts_with("study.toml:16:12: 'term.0.equation' has the unknown name 'sinn' "
                       "(expected one of A, P, t, "))
      << text;
  EXPECT_TRUE(text.ends_with("Did you mean 'sin'?\n    A * sinn(t/P)\n        ^")) << text;
}

TEST_F(OwnTermsConfig, MistakesAreSaid) {
  const auto with = [](const std::string& equation, const std::string& parameters) {
    return own_term("rumble", "drift.y", equation, parameters);
  };
  const std::string A = "A = { unit = 'deg/h', prior = 1 }", P = "P = { unit = 'min', value = 3 }";
  const std::pair<std::string, const char*> cases[] = {
      {with("A + 1e-6", A),
       "adds what does not vanish with 'A' (expected an equation proportional "
       "to 'A', which has a prior and no value: an amplitude)"},
      {with("A*t", A), "measures angle, but acts on drift.y, which measures angle time^-1"},
      {with("A", A + ", " + P), "does not name the parameter 'P'"},
      {with("A*(1 + P/(t - P))", A + ", P = { unit = 's', value = 60 }"),
       "is not a number where t = 60"},
      {with("A*sqrt(t/P)", A + ", " + P), "has no finite slope in t where t = 0"},
      {with("A*(t/P)^0.5", A + ", " + P), "has no finite slope in t where t = 0"},
      {own_term("rumble", "accelerometer.y", "A*f_I", "A = { prior = 1 }"),
       "names 'f_I', along an axis of a gyro"},
      {with("A*pressure*humidity*vibration*voltage*current", A),
       "names the column 'current' of the recording beside pressure, humidity, vibration, voltage"},
      {with("A", "A = { unit = 'deg/h' }"), "has neither prior nor value"},
      {with("A", "A = { unit = 'deg/hour', prior = 1 }"), "is no unit that the program knows"},
      {with("A", "A = { unit = 'deg/h', prior = -1 }"), "is not positive"},
      {with("A", "A = { unit = 'deg/h', prior = '1 g' }"), "measures something else"},
      {with("A", "A = { unit = 'deg/h', prior = 1, grid = [1, 2] }"), "belongs to an amplitude"},
      {with("A", "A = { unit = 'deg/h', prior = 1, sigma = 2 }"), "unknown key"},
      {with("A*t/P", A + ", P = { unit = 'min', value = 3, prior = { uniform = [1, 2] } }"),
       "is a distribution beside a value"},
      {with("A*t/P", A + ", P = { unit = 'min', value = 3, grid = [4] }"),
       "a list of 2 to 12 values"},
      {with("t", "t = { unit = 'deg/h', prior = 1 }"), "is what an equation sees of the platform"},
      {with("sin", "sin = { unit = 'deg/h', prior = 1 }"), "is a word of the equations"},
      {with("A + a", A + ", a = { unit = 'deg/h', prior = 1 }"), "capitals aside"},
      {own_term("rumble", "drift.w", "A", A), "acts_on"},
      {own_term("rumble", "drift.x", "A", "A = 3"), "parameters.A"},
      {"[[term]]\nkey = \"rumble\"\nacts_on = \"drift.x\"\nparameters = { A = { prior = 1 } }\n",
       "'term.0.equation' is missing"},
      {"[[term]]\nkey = \"rumble\"\nacts_on = \"drift.x\"\nequation = \"t\"\n",
       "'term.0.parameters' is missing"},
      {with("t", ""), "'term.0.parameters' is empty"},
      {"[[term]]\nkey = \"rumble\"\nacts_on = \"drift.x\"\nequation = 3\nparameters = { A = { "
       "prior = 1 } }\n",
       "an equation in quotes"}};
  for (const auto& [term, part] : cases) expect_says(mistake(term), part);
}

/// What begins at a time of its own stands still before.
TEST_F(OwnTermsConfig, ARootOfWhatStandsStillIsRead) {
  const std::string parameters =
      "A = { unit = 'deg/h', prior = 1 }, P = { unit = 'min', value = 3 }";
  for (const char* equation : {"A*sqrt(max(t/P - 1, 0))", "A*max(t/P - 1, 0)^0.5"})
    EXPECT_TRUE(mistakes(head + own_term("rumble", "drift.y", equation, parameters)).empty());
}

TEST_F(OwnTermsConfig, ATermHasANameOfItsOwn) {
  const std::string A = "A = { unit = 'deg/h', prior = 1 }";
  for (const char* key : {"drift_ramp", "Drift_Ramp", "M_x", "M", "1st", "a.b", "", "rumble",
                          "a_name_that_is_far_too_long_for_a_term"}) {
    SCOPED_TRACE(key);
    expect_says(mistake(rumble + own_term(key, "drift.x", "A", A)), "a name of its own");
  }
  // One that differs in capitals alone is not unknown too, where the study calls it.
  std::string called = head;
  for (std::size_t at; (at = called.find("rumble")) != std::string::npos;)
    called.replace(at, 6, "Drift_Ramp");
  const auto one = mistakes(called + own_term("Drift_Ramp", "drift.x", "A", A));
  ASSERT_EQ(one.size(), 1u);
  expect_says(one[0], "is the name of another");
  // rumble_A of the second is what the first calls its parameter A.
  expect_says(
      mistake(rumble + own_term("rumble_A", "drift.x", "x", "x = { unit = 'deg/h', prior = 1 }")),
      "a name of its own");
  expect_says(mistake(rumble + own_term("M", "drift.x", "x", "x = { unit = 'deg/h', prior = 1 }")),
              "is the name of another");
  std::string many = rumble;
  for (int i = 0; i < 6; ++i) many += own_term("t" + std::to_string(i), "drift.x", "A", A);
  expect_says(mistake(many), "the study brings 7 terms (expected at most 6 [[term]])");
  std::string params, sum = "0*A0";
  for (int i = 0; i < 7; ++i) {
    params += (i ? ", A" : "A") + std::to_string(i) + " = { unit = 'deg/h', prior = 1 }";
    sum += " + A" + std::to_string(i);
  }
  expect_says(mistake(own_term("rumble", "drift.x", sum, params)), "at most 6 parameters");
}

TEST_F(OwnTermsConfig, BelongsToPlatformsAndIsTheSameInEveryStudyPoint) {
  const auto all = mistakes(
      "schema = 1\n[site]\nlatitude = \"45 deg\"\n[plan]\nkind = "
      "\"strapdown\"\n[[filter]]\ncoupling = \"eq5\"\n" +
      rumble);
  ASSERT_EQ(all.size(), 1u);
  expect_says(all[0], "in a study of a strapdown recording");
  const auto swept = mistakes(head + rumble + "[sweep]\n\"term.0.title\" = [\"a\", \"b\"]\n");
  ASSERT_FALSE(swept.empty());
  expect_says(swept[0], "'term.0.title' cannot be swept");
}

}  // namespace
}  // namespace drift::own_terms_config_test
