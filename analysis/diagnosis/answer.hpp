#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/diagnosis/sentence.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// The table of every candidate that was tried.
void fill_candidates(const search::Examination& nominal, const search::Search& found, Diagnosis& d);

/// What was found about the noise; spikes: samples left out as outliers.
void fill_noise(const search::Examination& nominal, std::size_t spikes, Diagnosis& d);

/// The causes of the credible set (or, unexplained, none) and what they can be confused with.
void fill_causes(const search::Examination& nominal, const search::Search& found, Diagnosis& d);

/// Noise that drives all gyros alike is noise. Where one gyro alone explains the test decisively
/// better (twice the log likelihood by 10), it is something that happens to this axis: true, and
/// the equation and a p-value are put into `d`.
bool noise_of_one_axis(const search::Examination& nominal, Diagnosis& d);

}  // namespace drift::diagnosis
