#pragma once

#include "core/plan/test_plan.hpp"

namespace drift {

/// Memory that a test of so many samples takes when it is laid out and simulated or estimated
/// [bytes].
double memory_of_samples(double samples);

/// InputError (config) if a plan has more samples than there is memory for.
void require_memory_for(const TestPlan& plan);

}  // namespace drift
