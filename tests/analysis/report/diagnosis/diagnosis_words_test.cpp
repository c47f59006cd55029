#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/form_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::diagnosis_words_test {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;
using nlohmann::json;
using test::nominal;
using test::nominal_study;

TEST(DiagnosisWords, OfTheStrongestWindowSayTheEquationOnlyIfItIsAnother) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  EXPECT_NE(
      report::where_sentence(d.where).find("1200 s to 1800 s (chance of a false alarm: 1e-9)"),
      std::string::npos)
      << report::where_sentence(d.where);
  d.where.equation = "gimbal inner";
  EXPECT_NE(
      report::where_sentence(d.where).find("1200 s to 1800 s, as the platform rate y (chance"),
      std::string::npos)
      << report::where_sentence(d.where);
}

TEST(DiagnosisWords, BesideAxesInHoursAWindowIsToldInHoursToo) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  EXPECT_EQ(report::time_unit(d), report::TimeUnit::seconds);
  const auto table = [&] {
    return report::text_of(report::window_table(d.where, report::time_unit(d)));
  };
  EXPECT_NE(table().find("from [s]"), std::string::npos) << table();
  d.fit.residual_t = {60.0, 86400.0};
  EXPECT_EQ(report::time_unit(d), report::TimeUnit::hours);
  d.where.windows[0].start_s = 25200.0;
  d.where.windows[0].end_s = 27000.0;
  const auto said = [&] { return report::where_sentence(d.where, report::time_unit(d)); };
  EXPECT_NE(said().find("25200 s to 27000 s (7.00 h to 7.50 h; chance of a false"),
            std::string::npos)
      << said();
  EXPECT_NE(report::text_of({report::verdict(d)}, 400).find("7.00 h to 7.50 h"), std::string::npos);
  EXPECT_NE(table().find("from [h]"), std::string::npos) << table();
  EXPECT_NE(table().find("7.000"), std::string::npos) << table();
  EXPECT_EQ(json::parse(report::to_json(d))["where"]["windows"][0]["start_s"], 25200.0);
  d.where.windows[0].end_s = 25260.0;  // as many decimals as tell its ends apart
  EXPECT_NE(said().find("(7.000 h to 7.017 h; "), std::string::npos) << said();
  d.where.onset_s = 25200.0;
  EXPECT_NE(said().find("it sets in at 25200 s (7.00 h) and stays"), std::string::npos) << said();
  d.where.onset_s = std::nan("");
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0}, {"b.csv", 900.0, 86400.0, 800.0}};
  EXPECT_NE(said().find("of b.csv (7.000 h to 7.017 h through all recordings; chance"),
            std::string::npos)
      << said();
}

TEST(DiagnosisWords, ATorquerScaleOfMinusTwoIsTheSignOfTheCommands) {
  const auto with = [](double scale) {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::unexplained;
    remark::BeyondPrior beyond;
    beyond.parameters = {
        {{TermLibrary::find("s_x").value(), 0.0, scale, 5.8e-4, 0.0, 1e-3}, 2001.4, 1e-300}};
    beyond.of = 42;
    beyond.explains = true;
    d.remarks = {beyond};
    return report::brief_text(report::diagnosis_in_brief(d), 400);
  };
  const std::string reversed = with(-2.001417);
  EXPECT_NE(reversed.find("Next: correct the sign of cmd_x in the recording"), std::string::npos)
      << reversed;
  EXPECT_NE(reversed.find("a scale of -2 is a gain of -1, the sign of cmd_x"), std::string::npos)
      << reversed;
  EXPECT_EQ(reversed.find("widen"), std::string::npos) << reversed;
  EXPECT_NE(with(-1.9).find("Next: correct the prior of s_x, or widen it"), std::string::npos)
      << with(-1.9);
}

TEST(DiagnosisWords, AFormThatIsATermOfTheLibraryIsCalledByItsName) {
  Proposal p;
  p.acts_on = "drift.y";
  p.equation = "A*field_y";
  EXPECT_EQ(report::form_sentence(p).find("on this plan"), std::string::npos);
  p.known = "M_y";
  EXPECT_NE(report::form_sentence(p).find("drift.y += A*field_y, which on this plan is magnetic "
                                          "sensitivity, gyro y (magnetic_drift.y: M_y), with"),
            std::string::npos)
      << report::form_sentence(p);
  p.in_nominal = true;
  EXPECT_NE(report::form_sentence(p).find("The nominal model has that term"), std::string::npos);
  EXPECT_EQ(report::form_json(p)["known"], "M_y");
}

TEST(DiagnosisTables, SayALikenessOnceByItsAxis) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.causes[0].confusable_with = {
      {"sag", "", 0.99992}, {"sag", "x", -0.99991}, {"pier_tilt", "", 0.7}};
  const std::string out = report::text_of({report::what(d)}, 200);
  EXPECT_NE(out.find("  sag.x (-1.00), pier_tilt (0.70)"), std::string::npos) << out;
  d.causes[0].confusable_with[1].cosine = -0.9;  // all axes together are liker than one
  EXPECT_NE(report::text_of({report::what(d)}, 200).find("sag (1.00), sag.x (-0.90)"),
            std::string::npos);
}

TEST(DiagnosisTables, NearlyAllAbsorbedIsNotAll) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  for (const auto& [share, text] :
       {std::pair{0.93, "93 %"}, {0.9966, "99.7 %"}, {0.99962, "99.96 %"}, {0.004, "0.4 %"}}) {
    d.candidates[0].absorbed = share;
    EXPECT_NE(report::to_text(d).find(text), std::string::npos) << text;
  }
}

TEST(DiagnosisWords, NameChannelsAndEquations) {
  EXPECT_EQ(report::channel_in_words("acc_y"), "accelerometer y");
  EXPECT_EQ(report::channel_in_words("gimbal_outer"), "outer gimbal");
  EXPECT_EQ(report::channel_in_words("turn"), "the turns");
  EXPECT_EQ(report::equation_in_words("gimbal middle"), "middle gimbal");
  EXPECT_EQ(report::equation_in_words("platform rate y"), "platform rate y");
}

TEST(DiagnosisText, HasNoWordsOfTheMethodInTheNoteOnTheGain) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.fit.log_likelihood_ratio = 140.0;
  d.fit.linear_T = 144.0;
  const std::string out = report::to_text(d);
  EXPECT_EQ(out.find("linear score"), std::string::npos) << out;
  EXPECT_NE(out.find("gains 140 in twice the log likelihood; what"), std::string::npos) << out;
  d.causes[0].term = "frame_closure";  // another equation is no small change
  EXPECT_NE(report::to_text(d).find("gains 140 in twice the log likelihood."), std::string::npos)
      << report::to_text(d);
}

TEST(DiagnosisText, SaysTheVerdictFirstAndStaysWithinTheTerminal) {
  const std::string out = report::to_text(test::diagnosis(nominal()));
  EXPECT_TRUE(out.starts_with(
      "Verdict named: The nominal model lacks g-sensitive drift (mass unbalance), gyro y"))
      << out;
  for (const char* text :
       {"platform rate y", "eta_x", "Advice: g_drift.y and g_drift.z are 1.5 sigma apart",
        "gimbal_white", "9.10 →"})
    EXPECT_NE(out.find(text), std::string::npos) << text;
  EXPECT_LT(std::count(out.begin(), out.end(), '\n'), 60);
}

TEST(ResidualSignal, IsATableWithEmptyCellsForWhatIsNotKnown) {
  const diagnosis::Diagnosis d = test::diagnosis(nominal());
  const std::string csv = report::residual_signal_csv(d.signals);
  EXPECT_NE(csv.find("equation,time [s],position,value,sigma,explained,unit\n"), std::string::npos);
  EXPECT_NE(csv.find("platform rate y,60,1,0,0.1,0,deg/h\n"), std::string::npos);
  EXPECT_NE(csv.find("platform rate y,480,1,,0.1,0.644217687,deg/h\n"),
            std::string::npos);  // sin(0.7)
  EXPECT_NE(csv.find("# platform rate y = sets in at 1200 s and stays (correlation 0.90)"),
            std::string::npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 63);
}

TEST(SeveralRecordings, AreNamedWhereverATimeStands) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  diagnosis::Diagnosis d =
      test::diagnosis(study.filters.front());  // a window at 1200 to 1800 s, a signal up to 3600 s
  EXPECT_EQ(report::to_text(d).find("through all recordings"), std::string::npos);
  EXPECT_FALSE(json::parse(report::to_json(d))["where"].contains("recordings"));
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0},
                        {"b,2.csv", 900.0, 3600.0, 800.0}};  // b starts at 100 s of its own time
  const auto sentence = report::where_sentence(d.where);
  EXPECT_NE(sentence.find("the strongest window is 400 s to 1000 s of b,2.csv"), std::string::npos)
      << sentence;
  const json where = json::parse(report::to_json(d))["where"];
  EXPECT_EQ(where["windows"][0]["start_s"], 1200.0);
  EXPECT_EQ(where["windows"][0]["recording"], "b,2.csv");
  EXPECT_EQ(where["windows"][0]["start_in_recording_s"], 400.0);
  EXPECT_EQ(where["recordings"][1]["offset_s"], 800.0);
  const std::string page = report::to_html(report::diagnosis_report(study, d, {}));
  EXPECT_NE(page.find("b,2.csv begins at 900 s (100 s of its own time)"), std::string::npos);
  EXPECT_NE(page.find("400 to 1000"), std::string::npos);
  EXPECT_NE(page.find("time through all recordings [s]"), std::string::npos);
  const std::string csv = report::residual_signal_csv(d.signals, d.where.recordings);
  EXPECT_NE(csv.find("equation,time [s],position,value,sigma,explained,unit,recording\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("platform rate y,900,2,"), std::string::npos);
  const auto end_of = [&](const char* row) {
    return csv.substr(csv.find(row), csv.find('\n', csv.find(row)) - csv.find(row));
  };
  EXPECT_TRUE(end_of("platform rate y,900,").ends_with(",deg/h,a.csv"))
      << "a sample belongs where its interval ends";
  EXPECT_TRUE(end_of("platform rate y,960,").ends_with(",deg/h,\"b,2.csv\""));
  EXPECT_NE(csv.find("# b,2.csv = its own time is time [s] less 800\n"), std::string::npos);
}

TEST(DiagnosisFolder, ThePatchOfAnAmbiguousVerdictSaysWhichAlternativeItHolds) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  const std::string out = folder.file("out");
  report::write_results(study, d, {}, out);
  EXPECT_EQ(test::text_of(out + "/patched.toml").find('#'), std::string::npos)
      << "a named cause is no alternative";
  d.verdict = diagnosis::Verdict::ambiguous;
  d.causes.push_back(d.causes.front());
  d.causes.back().axis = "z";
  d.causes.back().set = 1;
  report::write_results(study, d, {}, out);
  const std::string patched = test::text_of(out + "/patched.toml");
  EXPECT_TRUE(patched.starts_with(
      "# The patched model (patched.toml) holds alternative (1) alone, the most probable of 2"))
      << patched;
  EXPECT_TRUE(mc::read_study(out + "/patched.toml")
                  .filters.front()
                  .active[TermLibrary::find("D_S_y").value()]);
  for (const std::string& text :
       {report::to_text(d), report::to_json(d), test::text_of(out + "/report.html")})
    EXPECT_NE(text.find("(patched.toml) holds alternative (1)"), std::string::npos) << text;
  d.causes.pop_back();
  EXPECT_NE(report::patch_text(d).find("it is not confirmed"), std::string::npos)
      << report::patch_text(d);
}

TEST(DiagnosisFolder, HoldsEverythingAndLeavesNoPatchOfAnEarlierDiagnosis) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  const std::string out = folder.file("out");
  report::write_results(study, test::diagnosis(study.filters.front()), {}, out);
  for (const char* name :
       {"diagnosis.json", "residual_signal.csv", "report.html", "study.toml", "patched.toml",
        "advised.toml", "where.svg", "signal.svg", "candidates.svg", "cosines.svg", "held_out.svg",
        "moved.svg", "residuals.svg"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
  const auto files = report::write_results(study, diagnosis::Diagnosis{}, {}, out);
  EXPECT_EQ(files.size(), 4u);
  EXPECT_FALSE(std::filesystem::exists(out + "/patched.toml"));
  EXPECT_FALSE(std::filesystem::exists(out + "/advised.toml"));
}

TEST(DiagnosisWords, ASettingThatTheTestDoesNotTellHasAllItsValues) {
  search::Cause c;
  c.term = "encoder_harmonics";
  c.axis = "outer";
  c.parameters = {{"enc_n", TermLibrary::find("enc_n").value(), 32.0, 0.0, "1", true}};
  EXPECT_TRUE(report::in_words(c).ends_with("(encoder_harmonics.outer: enc_n = 32)"))
      << report::in_words(c);
  c.parameters.back().any_of = {4.0, 8.0, 16.0, 32.0};
  EXPECT_TRUE(report::in_words(c).ends_with("enc_n = 4, 8, 16 or 32)")) << report::in_words(c);
}

}  // namespace
}  // namespace drift::diagnosis_words_test
