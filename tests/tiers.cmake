# Which tier a test belongs to, as filters of GoogleTest. Every test is `fast` unless it is named here;
# the fast ones take less than three minutes together on two cores. tests/architecture/check_tiers.cmake
# finds filters that select nothing.

# Seconds each: what simulates, diagnoses or runs the program many times over.
set(DRIFT_FULL_TESTS
  Advise.* AllanFit.* AdviceFollowed.* BetweenPoints.* BlindInterrupted.* BlindSmall.* BlindStudy.* Bytes.* CaseTemperature.* ClockDoubt.* CoarseReadout.* Crossed*.* DamageTold.* Diagnose.* Diagnose/FarBeyondPrior.* DiagnoseCommand.*
  Equation.* IsolatedSamplesOfSlews.* Estimators/EveryTermUnder.* EveryTerm*.* FailedWrite.* FoldersOfOthers.* HeadingDoubt.* LambdaFilter.* Matched*.*
  Nearest.* NothingReplaced.* OddInput.* OtherValley.* OwnTermCommands.* PolarLatitude.* RankCommand.* Rivals.* ScreenForms.* Documents.* Recording/BinaryFuzz.*
  RecordingFuzz.* Search.* Sensitivity.* SharedCandidates.* SharedTrials.* SharesOfExcess.* SiteDoubt.* SizeBeyondPrior.* Strapdown*.* StudyConfig.Misspelt*
  StudyMutation.* StudyReport.* WrongHemisphere.*
  SweepPictures.* UndeclaredWalk.* UnequalRowsDiagnosed.* UnknownField.* WhereFollows.* WrongPrior.*)
# Minutes each: not run unless asked for.
set(DRIFT_NIGHTLY_TESTS *Nightly*.* Estimators/EveryTermUnder.IsConsistentOrRefusedInSlews/batch)
