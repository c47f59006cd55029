#pragma once

#include <string>

#include "analysis/diagnosis/diagnosis.hpp"

namespace drift::report {

/// The diagnosis for machines: diagnosis.json of interfaces.md 6, schema 1. Values stand in the
/// unit named beside them; what is not a finite number is null. Beyond the keys listed there: of
/// causes `set` (causes with the same number act together), of candidates the numbers of the table,
/// and of several recordings the window's `recording` with its own times, and `noise`, `equations`,
/// `inseparable`, `remarks`, `seconds`.
std::string to_json(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
