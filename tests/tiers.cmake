# Which tier a test belongs to, as a filter of GoogleTest. Every test is `fast` unless it is named here;
# the fast ones take less than three minutes together on two cores. tests/architecture/check_tiers.cmake
# finds filters that select nothing.

# Seconds each: many simulations, whole commands, damaged files by the thousand.
set(DRIFT_FULL_TESTS
  AdviceFollowed.* Advise.* BlindSmall.* Diagnose.* DiagnoseCommand.* Equation.* EveryTermInAFilter.*
  Estimators/EveryTermUnder.* FitEitherEquation.* LambdaFilter.* MatchedFilter.* MatchedPair.* Nearest.Misspelt* RankCommand.* Readme.*
  Recording/BinaryFuzz.* RecordingFuzz.* Search.* Sensitivity.EquationsOfMotion* StrapdownDiagnosis.*
  StrapdownIdentify.* StrapdownRecordings.* StudyConfig.Misspelt* StudyMutation.* StudyReport.* SweepPictures.*)
# Minutes each: not run unless asked for.
set(DRIFT_NIGHTLY_TESTS
  Estimators/EveryTermUnder.IsConsistentOrRefusedInSlews/batch Estimators/EveryTermUnder.IsConsistentOrRefusedInTwelveSlews/*)
