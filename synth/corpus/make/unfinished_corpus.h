// A corpus while it is being made, piece by piece, so that an interrupted making can go on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/files/json.h"
#include "synth/corpus/corpus.h"

namespace chironomia {

// The hidden folder ".NAME.making" beside the corpus's own. It holds the order and, for each piece that is
// whole, a note of its records. It stays where it holds such a note, and goes where it holds none.
class UnfinishedCorpus {
  public:
    //   corpus   the folder that the corpus will be
    //   order    all that its bytes depend on
    // Throws Error if the folder cannot be written, or holds pieces of another order.
    UnfinishedCorpus(const std::filesystem::path& corpus, const Json& order);
    ~UnfinishedCorpus();
    UnfinishedCorpus(const UnfinishedCorpus&) = delete;
    UnfinishedCorpus& operator=(const UnfinishedCorpus&) = delete;

    // The folder of a corpus that will be `corpus`.
    static std::filesystem::path folder_beside(const std::filesystem::path& corpus);

    // The records of a piece that an earlier run has finished. Throws Error if its note is broken.
    std::optional<std::vector<CorpusEntry>> made(std::size_t piece) const;
    // That a piece is whole; from any number of threads, each for other pieces. Throws Error if it cannot be
    // written.
    void note(std::size_t piece, const std::vector<CorpusEntry>& entries) const;

    // Leaves the corpus alone in `place`, an empty folder beside its own. Throws Error if it cannot be moved.
    void finish(const std::filesystem::path& place);

  private:
    std::filesystem::path note_path(std::size_t piece) const;

    std::filesystem::path folder_;
};

}  // namespace chironomia
