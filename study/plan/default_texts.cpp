#include "study/plan/default_texts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <regex>

#include "core/files/files.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

// The same in English and in French.
using Text = std::array<std::string_view, 2>;

std::string say(const Text& text, const std::string& language) {
    return std::string(text[language == "fr" ? 1 : 0]);
}

const std::vector<Text> kAnswers = {{"A is clearly better", "A est nettement meilleure"},
                                    {"A is slightly better", "A est légèrement meilleure"},
                                    {"They are equal", "Elles se valent"},
                                    {"B is slightly better", "B est légèrement meilleure"},
                                    {"B is clearly better", "B est nettement meilleure"}};

const Text kFit = {"In which video do the character's movements fit the speech better?",
                   "Dans quelle vidéo les mouvements du personnage vont‑ils mieux avec ce qu’il dit ?"};
const Text kReal = {"In which video does the character move more like a real person?",
                    "Dans quelle vidéo le personnage bouge‑t‑il davantage comme une vraie personne ?"};
const Text kFitOfTwo = {"Which character's movements fit the speech better?",
                        "Quel personnage a les mouvements qui vont le mieux avec ce qui est dit ?"};
const Text kRealOfTwo = {"Which character moves more like a real person?",
                         "Quel personnage bouge davantage comme une vraie personne ?"};
const Text kFitOfAgent = {"In which video do the movements of {} fit the conversation better?",
                          "Dans quelle vidéo les mouvements de {} vont‑ils mieux avec la conversation ?"};
const Text kRealOfAgent = {"In which video does {} move more like a real person?",
                           "Dans quelle vidéo {} bouge‑t‑elle davantage comme une vraie personne ?"};
const Text kLeftPerson = {"the person on the left", "la personne de gauche"};
const Text kRightPerson = {"the person on the right", "la personne de droite"};
const Text kHowFitting = {"How well do the movements fit the speech?",
                          "À quel point les mouvements vont‑ils avec ce qui est dit ?"};
const Text kHowReal = {"How much does the character move like a real person?",
                       "À quel point le personnage bouge‑t‑il comme une vraie personne ?"};
const Text kNotAtAll = {"not at all", "pas du tout"};
const Text kVeryMuch = {"very much", "tout à fait"};
const Text kSimilar = {"Which animation is more like the Reference, A or B?",
                       "Quelle animation ressemble le plus à la référence, A ou B ?"};
const std::vector<Text> kSimilarity = {{"Very similar to A", "Très semblable à A"},
                                       {"Mostly similar to A", "Plutôt semblable à A"},
                                       {"In between", "Entre les deux"},
                                       {"Mostly similar to B", "Plutôt semblable à B"},
                                       {"Very similar to B", "Très semblable à B"}};
const std::vector<Text> kMarks = {
    {"excellent", "excellent"}, {"good", "bon"}, {"fair", "moyen"}, {"poor", "médiocre"}, {"bad", "mauvais"}};

std::vector<std::string> say_all(const std::vector<Text>& texts, const std::string& language) {
    std::vector<std::string> said;
    for (const Text& text : texts) said.push_back(say(text, language));
    return said;
}

// Which of two people a question is about.
std::string agent_of(const Plan& plan) {
    return say(plan.render.partner_on_left ? kRightPerson : kLeftPerson, plan.texts.language);
}

std::string text_of_pair(const Plan& plan) {
    const std::string& language = plan.texts.language;
    const bool sound = has_sound(plan);
    if (plan.clips.front().partner)
        return format(fmt::runtime(say(sound ? kFitOfAgent : kRealOfAgent, language)), agent_of(plan));
    if (plan.presentation == Presentation::one_video) return say(sound ? kFitOfTwo : kRealOfTwo, language);
    return say(sound ? kFit : kReal, language);
}

const Text kPairs = {"On each page you see two videos of a character, A and B.",
                     "Chaque page montre deux vidéos d’un personnage, A et B."};
const Text kTwoInOne = {"On each page you see a video of two characters, A on the left and B on the right.",
                        "Chaque page montre une vidéo de deux personnages, A à gauche et B à droite."};
const Text kPairsOfTwo = {"On each page you see two videos, A and B, of two people. Please look at {}.",
                          "Chaque page montre deux vidéos, A et B, de deux personnes. Veuillez regarder {}."};
const Text kSingles = {"On each page you see a video of a character.",
                       "Chaque page montre une vidéo d’un personnage."};
const Text kTriplets = {"On each page you see three videos: A, a Reference in the middle, and B.",
                        "Chaque page montre trois vidéos : A, une référence au milieu, et B."};
const Text kParallels = {
    "On each page you see several videos of a character; you choose which one is shown.",
    "Chaque page montre plusieurs vidéos d’un personnage ; vous choisissez celle qui est affichée."};
const Text kWithSound = {"Please watch to the end, with the sound on, and then answer the question below.",
                         "Veuillez regarder jusqu’à la fin, avec le son, puis répondre à la question."};
const Text kWithoutSound = {
    "Please watch to the end, and then answer the question below. There is no sound.",
    "Veuillez regarder jusqu’à la fin, puis répondre à la question. Il n’y a pas de son."};
const Text kNoWrong = {"There are no right or wrong answers; your own impression counts.",
                       "Il n’y a ni bonne ni mauvaise réponse ; c’est votre impression qui compte."};

std::string what_is_seen(const Plan& plan) {
    const std::string& language = plan.texts.language;
    if (plan.layout == Layout::single) return say(kSingles, language);
    if (plan.layout == Layout::triplet) return say(kTriplets, language);
    if (plan.layout == Layout::parallel) return say(kParallels, language);
    if (plan.clips.front().partner) return format(fmt::runtime(say(kPairsOfTwo, language)), agent_of(plan));
    return say(plan.presentation == Presentation::one_video ? kTwoInOne : kPairs, language);
}

}  // namespace

const std::vector<std::string>& bundled_languages() {
    static const std::vector<std::string> languages = {"en", "fr"};
    return languages;
}

bool is_bundled(const std::string& language) {
    return std::ranges::find(bundled_languages(), language) != bundled_languages().end();
}

Question default_question(const Plan& plan) {
    const std::string& language = plan.texts.language;
    const Text& how = has_sound(plan) ? kHowFitting : kHowReal;
    Question question;
    switch (plan.layout) {
        case Layout::single:
            question = {.id = "rating", .kind = QuestionKind::rating, .text = say(how, language)};
            question.points = 7;
            question.labels = {{1, say(kNotAtAll, language)}, {7, say(kVeryMuch, language)}};
            break;
        case Layout::parallel:
            question = {
                .id = "rating", .kind = QuestionKind::slider, .text = say(how, language), .each = true};
            question.least = 0;
            question.most = 100;
            question.marks = say_all(kMarks, language);
            break;
        case Layout::pair:
            question = {.id = "preference", .text = text_of_pair(plan)};
            question.answers = say_all(kAnswers, language);
            break;
        case Layout::triplet:
            question = {.id = "similarity", .text = say(kSimilar, language)};
            question.answers = say_all(kSimilarity, language);
            break;
    }
    return question;
}

std::string default_instructions(const Plan& plan) {
    const std::string& language = plan.texts.language;
    return what_is_seen(plan) + " " + say(has_sound(plan) ? kWithSound : kWithoutSound, language) + " " +
           say(kNoWrong, language);
}

std::string default_instruction(const std::string& language) {
    return say({"Attention check: on this page, please answer “{answer}”.",
                "Test d’attention : sur cette page, veuillez répondre « {answer} »."},
               language);
}

std::string default_instruction_of_video(const std::string& language) {
    return say({"Attention check: please give this video the value {answer}.",
                "Test d’attention : veuillez donner à cette vidéo la valeur {answer}."},
               language);
}

std::string default_agreement(const std::string& language) {
    return say({"I have read this and agree to take part", "J’ai lu ce texte et j’accepte de participer"},
               language);
}

const std::vector<PageText>& page_texts() {
    static const std::vector<PageText> texts = [] {
        const std::string source = read_text(find_asset("study/web/texts.js"));
        static const std::regex line(R"(\n    '?([\w.]+)'?: '([^'\n]*)')");
        std::vector<PageText> found;
        const auto end = source.begin() + static_cast<std::ptrdiff_t>(source.find("\n  },"));
        for (std::sregex_iterator match(source.begin(), end, line), none; match != none; ++match)
            found.push_back({.name = (*match)[1], .english = (*match)[2]});
        return found;
    }();
    return texts;
}

}  // namespace chironomia::study
