#include "core/physics/own/own_equation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/nearest.hpp"
#include "core/physics/expression/compile.hpp"
#include "core/physics/expression/degree.hpp"
#include "core/physics/expression/kelvins.hpp"
#include "core/physics/expression/parse.hpp"
#include "core/physics/expression/units_of.hpp"
#include "core/physics/own/own_inputs.hpp"
#include "core/physics/own/own_scenes.hpp"

namespace drift {
namespace {

/// What a target measures, and a unit of it for messages.
Unit unit_of_slot(OwnSlot slot) {
  switch (slot) {
    case OwnSlot::accelerometer:
      return unit::g;
    case OwnSlot::gimbal:
      return unit::arcsec;
    case OwnSlot::rate:
    case OwnSlot::drift:
      break;
  }
  return unit::deg_per_h;
}

/// The value of a step that may go wrong; what went wrong is thrown on to compile_equation().
template <class T>
T right_or_thrown(OrMistake<T> result) {
  if (EquationMistake* mistake = std::get_if<EquationMistake>(&result)) throw std::move(*mistake);
  return std::get<T>(std::move(result));
}

/// A name in a text.
struct Word {
  std::string text;
  std::size_t at = 0;
  bool called = false;  ///< a '(' follows, as on the name of a function
};

/// Every name of a text, functions and constants included, in its order.
std::vector<Word> words_in(std::string_view text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_",
                             inside =
                                 "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                 "0123456789";
  std::vector<Word> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of(inside, at), text.size());
    const std::size_t next = text.find_first_not_of(" \t", end);
    if (letters.find(text[at]) != std::string_view::npos)
      words.push_back({std::string(text.substr(at, end - at)), at,
                       next != std::string_view::npos && text[next] == '('});
    at = std::max(end, at + 1);  // figures and what hangs on them ("1e3") are passed over
  }
  return words;
}

class EquationCompiler {
 public:
  EquationCompiler(const OwnEquation& equation, const std::vector<std::string>& covariates)
      : e_(equation) {
    out_.covariates = covariates;
    for (const OwnInput& input : own_inputs) inputs_.emplace_back(input.name.view());
  }

  CompiledEquation compile() {
    find_covariates();
    inputs_.insert(inputs_.end(), out_.covariates.begin(), out_.covariates.end());
    const EquationTree tree = right_or_thrown(parse_equation(e_.text, {inputs_, e_.names}));
    look_at_names(tree);
    check_degree(tree);
    check_dimension(tree);
    check_kelvins(tree);
    out_.program = right_or_thrown(compile_tree(tree));
    if (auto mistake = mistake_in_scenes(out_.program, e_.params, inputs_))
      throw std::move(*mistake);
    return std::move(out_);
  }

 private:
  /// Unknown names that no slip of the keyboard explains are columns of the recording. No column is
  /// called as a function is.
  void find_covariates() {
    const std::vector<std::string_view> reserved = reserved_equation_names();
    std::vector<std::string_view> values{"pi"};
    values.insert(values.end(), e_.names.begin(), e_.names.end());
    values.insert(values.end(), inputs_.begin(), inputs_.end());
    for (const Word& word : words_in(e_.text)) {
      const auto among = [&](const auto& list) {
        return std::ranges::find(list, word.text) != list.end();
      };
      if (word.called || among(reserved) || among(values) || among(out_.covariates)) continue;
      check_slip(word, values);
      if (out_.covariates.size() == most_further_columns)
        throw EquationMistake{
            word.at,
            fmt::format("names the column '{}' of the recording beside {}", word.text,
                        fmt::join(out_.covariates, ", ")),
            fmt::format("at most {} further columns in all terms of a study", most_further_columns),
            "Name fewer columns, or correct the name"};
      out_.covariates.push_back(word.text);
    }
  }
  static void check_slip(const Word& word, const std::vector<std::string_view>& values) {
    std::vector<std::string_view> meant;
    for (const std::string_view value : values)
      if (config::is_slip(word.text, value)) meant.push_back(value);
    if (meant.empty()) return;
    throw EquationMistake{
        word.at, fmt::format("has the unknown name '{}'", word.text),
        fmt::format("one of {}, or the name of a column of the recording", fmt::join(values, ", ")),
        fmt::format("{} If it is a column, give it a name less like that in [recording] of the "
                    "study: columns = {{ another_name = \"{} [its unit]\" }}",
                    config::suggestion(word.text, meant), word.text)};
  }

  void look_at_names(const EquationTree& tree) {
    std::vector<bool> used(e_.names.size(), false);
    for (const auto& node : tree.nodes) {
      const auto index = static_cast<std::size_t>(node.index);
      if (node.op == Operation::parameter) used[index] = true;
      if (node.op != Operation::input) continue;
      if (index >= own_inputs.size()) {
        out_.needs.covariates |= further_column(index - own_inputs.size());
        continue;
      }
      const OwnInput& input = own_inputs[index];
      out_.needs = out_.needs | input.needs;
      if (input.of_gyro && e_.target.slot != OwnSlot::drift)
        throw EquationMistake{
            node.at, fmt::format("names '{}', along an axis of a gyro", input.name.view()),
            "f_I, f_O, f_S with acts_on = \"drift.x\", \"drift.y\" or \"drift.z\" only",
            "Write f_x, f_y or f_z"};
    }
    if (const auto idle = std::ranges::find(used, false); idle != used.end())
      throw EquationMistake{e_.text.size(),
                            fmt::format("does not name the parameter '{}'",
                                        e_.names[static_cast<std::size_t>(idle - used.begin())]),
                            "every parameter of the term in the equation", "Use it, or remove it"};
  }
  void check_degree(const EquationTree& tree) const {
    std::vector<bool> amplitude;
    for (const ParamSpec& spec : e_.params) amplitude.push_back(spec.amplitude());
    if (auto mistake = mistake_of_degree(tree, amplitude, e_.names)) throw std::move(*mistake);
  }
  void check_dimension(const EquationTree& tree) const {
    std::vector<MaybeDimension> inputs, params;
    for (const OwnInput& input : own_inputs) inputs.emplace_back(input.dimension);
    inputs.resize(inputs_.size());  // nobody knows what columns of a recording measure
    for (const ParamSpec& spec : e_.params) params.emplace_back(spec.unit.dim);
    const auto whole = right_or_thrown(dimension_of(tree, inputs, params));
    const Unit wanted = unit_of_slot(e_.target.slot);
    if (whole && *whole != wanted.dim)
      throw EquationMistake{
          tree.nodes.back().at,
          fmt::format("measures {}, but acts on {}, which measures {}", dimension_in_words(*whole),
                      name_in(own_targets, e_.target), dimension_in_words(wanted.dim)),
          fmt::format("parameters with which the equation comes to a quantity in {}",
                      wanted.symbol.view()),
          "Correct the unit of a parameter"};
  }

  void check_kelvins(const EquationTree& tree) const {
    std::vector<std::optional<KelvinParameter>> kelvins(e_.names.size());
    for (std::size_t k = 0; k < kelvins.size(); ++k)
      if (const ParamSpec& spec = e_.params[k]; celsius_offset(spec.unit) != 0.0)
        kelvins[k] = {e_.names[k], spec.prior.mean()};
    if (auto mistake = mistake_of_kelvins(tree, own_inputs.size(), kelvins))
      throw std::move(*mistake);
  }

  const OwnEquation& e_;
  std::vector<std::string> inputs_;  ///< names, the columns of the recording last
  CompiledEquation out_;
};

}  // namespace

OrMistake<CompiledEquation> compile_equation(const OwnEquation& equation,
                                             const std::vector<std::string>& covariates) {
  try {
    return EquationCompiler(equation, covariates).compile();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
}

}  // namespace drift
