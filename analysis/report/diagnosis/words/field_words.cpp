#include "analysis/report/diagnosis/words/field_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/preparation/assumed_field.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

constexpr CovariateSpec magnetic = covariate("field");

std::string in_gauss(const Vec3& field_l) {
  const Vec3 shown = field_l / magnetic.unit.to_si;
  return fmt::format("{:.3f}, {:.3f}, {:.3f}", shown.x(), shown.y(), shown.z());
}

std::string spread_beside_dipole() {
  return fmt::format("{:.2f} {} an axis", preparation::beside_dipole / magnetic.unit.to_si,
                     magnetic.unit.symbol.view());
}

Vec3 field_sigmas(const identification::FieldFound& f) {
  return f.covariance.diagonal().cwiseSqrt();
}

}  // namespace

std::vector<std::string> following_field(const Diagnosis& d) {
  std::vector<std::string> labels;
  const auto add = [&](std::string label) {
    if (std::ranges::find(labels, label) == labels.end()) labels.push_back(std::move(label));
  };
  for (const search::Cause& c : d.causes)
    if (const auto term = TermLibrary::find_term(c.term))
      if (identification::follows_field(TermLibrary::terms[*term]))
        add(search::keyed(c.term, c.axis));
  if (const auto* beyond = remark_in<remark::BeyondPrior>(d))
    for (const remark::BeyondPrior::Parameter& p : beyond->parameters)
      for (const TermInfo& t : TermLibrary::terms)
        if (identification::follows_field(t) && t.first <= p.estimate.param &&
            p.estimate.param < t.first + t.count)
          add(parameter_key(p.estimate.param));
  return labels;
}

std::string field_text(const Diagnosis& d) {
  if (d.field && d.field->another())
    return fmt::format(
        " The magnetic field was not measured: taken is the one that this recording shows, {}±{} "
        "{} North, West, Up, for the Earth's is a dipole's within {}; the error of the field is in "
        "the intervals.",
        in_gauss(d.field->field_l), in_gauss(field_sigmas(*d.field)), magnetic.unit.symbol.view(),
        spread_beside_dipole());
  if (d.field)
    return fmt::format(
        " The magnetic field is assumed, a dipole's within {}; that error is in the intervals.",
        spread_beside_dipole());
  if (remark_in<remark::FieldAssumed>(d) && !following_field(d).empty())
    return " The magnetic field is assumed, a dipole's: sizes that follow it are as wrong as that.";
  return "";
}

std::string field_doubt(const Diagnosis& d) {
  const auto labels = following_field(d);
  if (labels.empty() || (!d.field && !remark_in<remark::FieldAssumed>(d))) return "";
  return fmt::format(
      "{} {} on a magnetic field that is {}: declare field_n, field_w, field_u in "
      "[environment].",
      listed(labels, "and"), labels.size() > 1 ? "hang" : "hangs",
      d.field && d.field->another() ? "this recording's own, as far as it shows it"
                                    : "assumed, a dipole's");
}

Json field_json(const Diagnosis& d) {
  if (!d.field) return nullptr;
  const auto list = [](const Vec3& v) {
    const Vec3 shown = v / magnetic.unit.to_si;
    return Json::array({shown.x(), shown.y(), shown.z()});
  };
  return {{"unit", magnetic.unit.symbol.view()},
          {"assumed", list(d.field->assumed_l)},
          {"of_recording", list(d.field->field_l)},
          {"sigma", list(field_sigmas(*d.field))},
          {"log_evidence", d.field->log_evidence},
          {"taken", d.field->another() ? "of_recording" : "assumed"}};
}

}  // namespace drift::report
