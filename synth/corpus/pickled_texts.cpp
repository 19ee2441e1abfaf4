#include "synth/corpus/pickled_texts.h"

#include <cstdint>
#include <map>

namespace chironomia {
namespace {

// Operations by their letters: Python's Lib/pickletools.py.
enum Op : unsigned char {
    kMark = '(',
    kStop = '.',
    kBinInt = 'J',
    kBinInt1 = 'K',
    kBinInt2 = 'M',
    kNone = 'N',
    kReduce = 'R',
    kShortBytes = 'C',
    kUnicode = 'X',
    kAppend = 'a',
    kBuild = 'b',
    kGlobal = 'c',
    kAppends = 'e',
    kGet = 'h',
    kLongGet = 'j',
    kPut = 'q',
    kLongPut = 'r',
    kTuple = 't',
    kEmptyTuple = ')',
    kEmptyList = ']',
    kProtocol = 0x80,
    kTuple1 = 0x85,
    kTuple2 = 0x86,
    kTuple3 = 0x87,
    kTrue = 0x88,
    kFalse = 0x89,
    kShortUnicode = 0x8c,
    kStackGlobal = 0x93,
    kMemoize = 0x94,
    kFrame = 0x95,
};

// Follows one pickle; what is on the stack is of interest only as far as it is a text.
class Follower {
  public:
    explicit Follower(std::string_view pickle) : rest_(pickle) {}

    std::optional<std::vector<std::string>> run() {
        while (!broken_) {
            const auto op = static_cast<unsigned char>(number(1));
            if (op == kStop) break;
            step(op);
        }
        if (broken_ || !complete_) return std::nullopt;
        return std::move(texts_);
    }

  private:
    // A text where it stands in the pickle; nothing: no text.
    using Value = std::optional<std::string_view>;
    // A text is written once and may be repeated in two bytes: a small pickle could fill all memory.
    static constexpr std::size_t kMostBytes = std::size_t{1} << 24;

    void step(unsigned char op) {
        switch (op) {
            case kShortUnicode:
                return push(text(number(1)));
            case kUnicode:
                return push(text(number(4)));
            case kShortBytes:
                skip(number(1));
                return push(std::nullopt);
            case kBinInt1:
                skip(1);
                return push(std::nullopt);
            case kBinInt2:
                skip(2);
                return push(std::nullopt);
            case kBinInt:
                skip(4);
                return push(std::nullopt);
            case kGlobal:
                skip_lines();
                return push(std::nullopt);
            case kGet:
                return recall(number(1));
            case kLongGet:
                return recall(number(4));
            case kPut:
                return keep(number(1));
            case kLongPut:
                return keep(number(4));
            case kMemoize:
                return keep(memo_.size());
            case kProtocol:
                return skip(1);
            case kFrame:
                return skip(8);
            case kEmptyList:
                return begin_list();
            case kAppend:
            case kAppends:
                return end_list();
            case kNone:
            case kTrue:
            case kFalse:
            case kEmptyTuple:
                return push(std::nullopt);
            case kMark:
            case kReduce:
            case kBuild:
            case kTuple:
            case kTuple1:
            case kTuple2:
            case kTuple3:
            case kStackGlobal:
                last_ = std::nullopt;
                return;
            default:
                broken_ = true;
        }
    }

    void push(Value value) {
        last_ = std::move(value);
        if (!in_list_ || broken_) return;
        bytes_ += last_ ? last_->size() + sizeof(std::string) : 0;
        if (last_ && bytes_ <= kMostBytes)
            texts_.emplace_back(*last_);
        else
            broken_ = true;
    }

    void begin_list() {
        texts_.clear();
        bytes_ = 0;
        last_ = std::nullopt;
        in_list_ = true;
        complete_ = false;
    }

    // A long list comes in pieces, each with an end of its own.
    void end_list() {
        complete_ = true;
        in_list_ = continues_list();
    }
    bool continues_list() const { return !rest_.empty() && rest_.front() == kMark; }

    void keep(std::uint64_t index) { memo_[index] = last_; }

    void recall(std::uint64_t index) {
        const auto found = memo_.find(index);
        if (found == memo_.end())
            broken_ = true;
        else
            push(found->second);
    }

    void skip(std::uint64_t count) { text(count); }

    std::string_view text(std::uint64_t count) {
        if (count > rest_.size()) {
            broken_ = true;
            return {};
        }
        const std::string_view found = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return found;
    }

    // Little-endian.
    std::uint64_t number(std::size_t size) {
        std::uint64_t value = 0;
        const std::string_view bytes = text(size);
        for (std::size_t i = bytes.size(); i > 0; --i)
            value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
        return value;
    }

    // The module and the name of a function.
    void skip_lines() {
        for (int line = 0; line < 2; ++line) {
            const std::size_t end = rest_.find('\n');
            skip(end == std::string_view::npos ? rest_.size() + 1 : end + 1);
        }
    }

    std::string_view rest_;
    std::map<std::uint64_t, Value> memo_;
    Value last_;
    std::vector<std::string> texts_;
    std::size_t bytes_ = 0;  // of the texts
    bool in_list_ = false, complete_ = false, broken_ = false;
};

}  // namespace

std::optional<std::vector<std::string>> pickled_texts(std::string_view pickle) {
    return Follower(pickle).run();
}

}  // namespace chironomia
