#pragma once

// Whether this processor has the instructions that the program was compiled for. Without them the
// program would end at the first one by SIGILL, which tells nobody anything.

namespace drift {

/// The extensions of x86-64 that this build uses, as the compiler names them, apart by blanks:
/// " avx2 fma "; " " where it uses none. Looked at before main() (look.cpp): where one is lacking,
/// a message says so and the program exits with 2.
extern const char needed_instructions[];

}  // namespace drift
