#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/report/page/degeneracies.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {

/// Members keep their order. A number that is not finite is written as null.
using Json = nlohmann::ordered_json;

/// The rows of a table as objects, all of them: of `keys`, "start_s end_s score", these members in
/// this order; without, every column that has a key.
Json rows_json(const Table& table, std::string_view keys = {});

/// Directions of the parameters with their coefficients and reasons.
Json directions_json(const std::vector<NamedDirection>& directions);

/// Null for a text that is empty.
Json text_or_null(const std::string& text);

/// Adds the rows of every table that has an id, under its id, where the document has none.
void add_tables(Json& document, const std::vector<Section>& sections);

/// The document as text. Names are free text; bytes that are not UTF-8 become U+FFFD.
std::string dumped(const Json& document);

}  // namespace drift::report
