// What the program says on stderr: lines that scripts and people can read, whatever files, names and
// libraries put into them. Printing never throws, and never waits for anything but the stream.
#pragma once
#include <string_view>

namespace espalier {

/// "espalier: TEXT" as one_line (core/text/one_line.h) writes it, of at most 300 bytes.
void print_message(std::string_view text);
/// "espalier: warning: TEXT", which may list more: at most 600 bytes.
void print_warning(std::string_view text);
/// These bytes, as they are.
void print_to_stderr(std::string_view bytes);

/// Streams that whoever began the program has closed become those of /dev/null: a file that is opened later
/// must not be taken for one of them.
void open_closed_streams();

/// Whether all that was printed on stdout has reached it; says so on stderr where it has not.
bool flush_output();

}  // namespace espalier
