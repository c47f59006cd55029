// The whole program with cheap runs in place of simulations: driftscope_synthetic. What a run does
// comes from the study's title, "synthetic key=value ...": columns, fail_every, throw_at, stop_at,
// together, ms, points, half_width. DRIFT_SYNTHETIC_SCALE=x in the environment makes it a program
// with other results.
#include <cstdlib>
#include <sstream>

#include "analysis/cli/study_program.hpp"
#include "tests/support/synthetic_task.hpp"

namespace drift::cli {

StudyProgram study_program() {
  const auto work = [](const mc::Study& study) {
    test::SyntheticOptions o;
    o.seed = study.monte_carlo.seed;
    std::size_t points = 1;
    double half_width = 0.0;
    std::istringstream words(study.title);
    for (std::string word; words >> word;) {
      const auto equals = word.find('=');
      if (equals == std::string::npos) continue;
      const std::string key = word.substr(0, equals);
      const double value = std::stod(word.substr(equals + 1));
      if (key == "columns") o.columns = static_cast<std::size_t>(value);
      if (key == "fail_every") o.fail_every = static_cast<std::uint64_t>(value);
      if (key == "throw_at") o.throw_at = static_cast<std::uint64_t>(value);
      if (key == "stop_at") o.stop_at = static_cast<std::uint64_t>(value);
      if (key == "together") o.together = static_cast<std::size_t>(value);
      if (key == "ms") o.milliseconds = value;
      if (key == "points") points = static_cast<std::size_t>(value);
      if (key == "half_width") half_width = value;
    }
    mc::StudyWork w;
    for (std::size_t p = 0; p < points; ++p) {
      const char* scale = std::getenv("DRIFT_SYNTHETIC_SCALE");
      o.scale = (scale != nullptr ? std::stod(scale) : 1.0) + static_cast<double>(p);
      w.points.push_back({points > 1 ? "scale = " + std::to_string(p + 1) : "",
                          std::make_unique<test::SyntheticTask>(o)});
    }
    if (half_width > 0.0)
      w.stop_rules = [=](std::size_t) {
        return std::make_unique<test::MeanRule>(o.columns, half_width);
      };
    return w;
  };
  return {work,
          [](const mc::Study&, const mc::StudyWork&, mc::StudyReader&, const std::string&) {}};
}

}  // namespace drift::cli
