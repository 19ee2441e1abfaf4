// Options about who is in a clip: how a motion is read, the face, what is hidden.
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/clip/clip.h"

namespace chironomia::study {

// How a motion is read: what each option makes of its text.
struct HintOption {
    const char* name;
    const char* type;
    const char* help;
    void (*read)(MotionHints& hints, const std::string& text);
};

std::span<const HintOption> hint_options();

void add_motion_hints(CLI::App& verb, MotionHints& hints);

// The face of one person.
void add_face(CLI::App& verb, std::optional<std::filesystem::path>& face, FaceOptions& options);

// What one person is given, by an option of this name: "--face", or "motion,--motion" where no name need stand before
// the value.
struct PersonOption {
    std::string names;
    std::string type;
    std::string help;
    // may be called several times; its Error becomes a message about the option
    std::function<void(Performer&, const std::string& text)> read;
    bool is_of_one = false;  // it cannot hold for two people
};

// The people of a clip, from options that may be given once for all of them or once for each.
class PeopleOptions {
  public:
    CLI::Option* add(CLI::App& verb, const PersonOption& option);

    bool has(const std::string& name) const;

    // As many people as motions, or as faces where there are no motions. An option that is given once holds for all of
    // them, unless it `is_of_one`. Throws CLI::ValidationError if the numbers do not go together.
    std::vector<Performer> make() const;

  private:
    struct Given {
        std::string name;
        PersonOption option;
        std::vector<std::string> texts;
    };

    static void distribute(const Given& given, const Given& counted, std::vector<Performer>& people);

    std::list<Given> given_;  // the motions first
};

// The faces of the people, and what is hidden of them.
void add_faces(CLI::App& verb, PeopleOptions& people);
void add_modes(CLI::App& verb, PeopleOptions& people);

// What is done to their motions on purpose.
void add_anchors(CLI::App& verb, PeopleOptions& people);

// One sound belongs to the clip; two are the voices of its two people. Throws CLI::ValidationError if there
// are more sounds than people.
void distribute_sounds(const std::vector<std::string>& sounds, ClipJob& job);

}  // namespace chironomia::study
