// A script put together from the texts between tags.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace chironomia {

// White space of any length becomes one space, none stays at the ends, and one is put after an ellipsis.
class ScriptBuilder {
  public:
    void add(std::string_view text);

    // A phrase ends or begins here: its words do not run into those of the next one ("</theme><rheme>").
    void part() { is_parted_ = true; }

    // Where the next character of a word will be, or before.
    std::size_t size() const { return script_.size(); }
    const std::string& script() const { return script_; }

  private:
    bool needs_space(std::string_view next) const;

    std::string script_;
    bool has_space_ = false;
    bool is_parted_ = false;
};

}  // namespace chironomia
