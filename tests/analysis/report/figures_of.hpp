#pragma once

#include <vector>

#include "analysis/report/page/report.hpp"

namespace drift::test {

/// All figures of some sections, in their order.
inline std::vector<report::Figure> figures_of(const std::vector<report::Section>& sections) {
  std::vector<report::Figure> figures;
  for (const report::Section& section : sections)
    for (const report::Block& block : section.blocks)
      if (const auto* figure = std::get_if<report::Figure>(&block.content))
        figures.push_back(*figure);
  return figures;
}

}  // namespace drift::test
