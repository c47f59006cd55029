#pragma once

namespace drift::mc {

/// Lets this process have as many files open as the machine allows it (the hard limit): a reader of
/// results has those of all workers, and the usual limit of 1,024 ends at about so many.
void allow_many_files();

}  // namespace drift::mc
