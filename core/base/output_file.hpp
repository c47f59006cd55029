#pragma once

#include <functional>
#include <string>
#include <vector>

namespace drift {

/// What a file is, in the words of a message ("no recording of driftscope"), or empty if it is one
/// that the command may replace.
using Stranger = std::function<std::string(const std::string& path)>;

/// Looks at a file that a command is to write, before anything is computed. An empty file may be
/// replaced. InputError: usage if it is one of the inputs, whatever it is called there; store if
/// there is one already that is a stranger; io if none can be written there. Removes what killed
/// processes left unfinished beside it.
void require_output_file(const std::string& path, const std::vector<std::string>& inputs,
                         const Stranger& stranger);

}  // namespace drift
