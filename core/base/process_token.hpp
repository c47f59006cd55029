#pragma once

#include <string>
#include <string_view>

namespace drift {

/// Which process this is, in a word that can stand in a file's name or in a file: the machine,
/// since when it runs, which of its processes can be seen, number and start of the process.
std::string process_token();

/// What is known here of the process that a token names.
enum class Maker {
  at_work,
  ended,
  unseen,  ///< on another machine or in another container
  none     ///< the text is no token
};
Maker maker_of(std::string_view token);

}  // namespace drift
