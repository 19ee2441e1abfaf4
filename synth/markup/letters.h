// Characters of Unicode: as BERT's uncased vocabulary sees them, and texts in one form.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

// Taken apart into letters and accents (NFD), lower case, without the accents; `text` is UTF-8.
std::u32string bare_letters(std::string_view text);

// With letters and accents in one character where there is one (NFC), so that texts which look alike are alike: macOS
// takes them apart in the names of files, and so do texts that are written there. What is no UTF-8 stays as it is.
std::string composed(std::string_view text);

bool is_blank(char32_t character);        // white space
bool is_unprintable(char32_t character);  // control characters, and those without a meaning of their own
bool is_punctuation(char32_t character);  // of Unicode, and ASCII's symbols: "$", "^"
bool is_capital(char32_t character);      // a letter, of which there is a small one, too
bool is_cjk(char32_t character);          // a Chinese character: a word of its own

}  // namespace chironomia
