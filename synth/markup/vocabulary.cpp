#include "synth/markup/vocabulary.h"

#include <algorithm>

#include "core/text.h"
#include "synth/markup/script_words.h"

namespace chironomia {
namespace {

using enum MarkKind;
using enum CuePlace;

constexpr Cue kEnglishCues[] = {
    {"hello", performative, "greet", 0.9, clause_start},
    {"hi", performative, "greet", 0.9, clause_start},
    {"welcome", performative, "greet", 0.85, clause_start},
    {"good morning", performative, "greet", 0.9, clause_start},
    {"good afternoon", performative, "greet", 0.9, clause_start},
    {"good evening", performative, "greet", 0.9, clause_start},
    {"goodbye", performative, "goodbye", 0.9, clause_start},
    {"good bye", performative, "goodbye", 0.9, clause_start},
    {"bye", performative, "goodbye", 0.9, clause_start},
    {"good night", performative, "goodbye", 0.9, clause_start},
    {"see you", performative, "goodbye", 0.85, clause_start},
    {"thank you", performative, "thank", 0.8},
    {"thanks", performative, "thank", 0.8, clause_start},
    {"many thanks", performative, "thank", 0.8, clause_start},
    {"sorry", performative, "apologise", 0.75},
    {"i apologise", performative, "apologise", 0.75},
    {"i apologize", performative, "apologise", 0.75},
    {"excuse me", performative, "apologise", 0.6},
    {"pardon me", performative, "apologise", 0.65},
    {"yes", performative, "agree", 0.65, clause_start},
    {"yeah", performative, "agree", 0.65, clause_start},
    {"okay", performative, "agree", 0.5, clause_start},
    {"exactly", performative, "agree", 0.65, clause_start},
    {"that's right", performative, "agree", 0.65, clause_start},
    {"you are right", performative, "agree", 0.65, clause_start},
    {"i agree", performative, "agree", 0.65},
    {"no", performative, "refuse", 0.7, clause_start},
    {"never", performative, "refuse", 0.6},
    {"not at all", performative, "refuse", 0.7},
    {"i disagree", performative, "refuse", 0.7},
    {"i refuse", performative, "refuse", 0.75},
    {"don't", performative, "refuse", 0.42},
    {"doesn't", performative, "refuse", 0.38},
    {"didn't", performative, "refuse", 0.38},
    {"can't", performative, "refuse", 0.42},
    {"cannot", performative, "refuse", 0.42},
    {"won't", performative, "refuse", 0.42},
    {"nothing", performative, "refuse", 0.52},
    {"nobody", performative, "refuse", 0.52},
    {"let's", performative, "suggest", 0.55, clause_start},
    {"let us", performative, "suggest", 0.55, clause_start},
    {"how about", performative, "suggest", 0.6, clause_start},
    {"why don't we", performative, "suggest", 0.6, clause_start},
    {"you should", performative, "suggest", 0.52},
    {"you could", performative, "suggest", 0.5},
    {"we should", performative, "suggest", 0.5},
    {"i suggest", performative, "suggest", 0.55},
    {"please", performative, "order", 0.6, clause_start},
    {"of course", certainty, "certain", 0.62},
    {"certainly", certainty, "certain", 0.6},
    {"definitely", certainty, "certain", 0.62},
    {"absolutely", certainty, "certain", 0.65},
    {"obviously", certainty, "certain", 0.55},
    {"clearly", certainty, "certain", 0.5},
    {"no doubt", certainty, "certain", 0.58},
    {"i am sure", certainty, "certain", 0.55},
    {"i'm sure", certainty, "certain", 0.55},
    {"always", certainty, "certain", 0.45},
    {"maybe", certainty, "uncertain", 0.62},
    {"perhaps", certainty, "uncertain", 0.6},
    {"probably", certainty, "uncertain", 0.48},
    {"possibly", certainty, "uncertain", 0.52},
    {"i don't know", certainty, "uncertain", 0.72},
    {"i do not know", certainty, "uncertain", 0.72},
    {"i guess", certainty, "uncertain", 0.55},
    {"who knows", certainty, "uncertain", 0.75},
    {"might", certainty, "uncertain", 0.38},
    {"not sure", certainty, "uncertain", 0.65},
    {"but", belief_relation, "contrast", 0.55, clause_start},
    {"however", belief_relation, "contrast", 0.65},
    {"although", belief_relation, "contrast", 0.5, clause_start},
    {"instead", belief_relation, "contrast", 0.5},
    {"on the other hand", belief_relation, "contrast", 0.8},
    {"on the one hand", belief_relation, "contrast", 0.75},
    {"nevertheless", belief_relation, "contrast", 0.6},
    {"whereas", belief_relation, "contrast", 0.55},
    {"yet", belief_relation, "contrast", 0.45, clause_start},
    {"because", belief_relation, "cause-effect", 0.48},
    {"therefore", belief_relation, "cause-effect", 0.6},
    {"so", belief_relation, "cause-effect", 0.42, clause_start},
    {"that's why", belief_relation, "cause-effect", 0.6},
    {"as a result", belief_relation, "cause-effect", 0.6},
    {"consequently", belief_relation, "cause-effect", 0.55},
    {"if", belief_relation, "condition", 0.42, clause_start},
    {"unless", belief_relation, "condition", 0.48, clause_start},
    {"otherwise", belief_relation, "condition", 0.5},
    {"for example", belief_relation, "elaborate", 0.52},
    {"for instance", belief_relation, "elaborate", 0.52},
    {"in other words", belief_relation, "elaborate", 0.55},
    {"that is to say", belief_relation, "elaborate", 0.5},
    {"in fact", belief_relation, "elaborate", 0.48},
    {"first", belief_relation, "enumerate", 0.62, clause_start},
    {"first of all", belief_relation, "enumerate", 0.65, clause_start},
    {"firstly", belief_relation, "enumerate", 0.62, clause_start},
    {"second", belief_relation, "enumerate", 0.6, clause_start},
    {"secondly", belief_relation, "enumerate", 0.6, clause_start},
    {"third", belief_relation, "enumerate", 0.58, clause_start},
    {"thirdly", belief_relation, "enumerate", 0.58, clause_start},
    {"finally", belief_relation, "enumerate", 0.5, clause_start},
    {"here", deictic, "place-here", 0.58},
    {"over here", deictic, "place-here", 0.7},
    {"over there", deictic, "place-there", 0.75},
    {"up there", deictic, "place-there", 0.75},
    {"there", deictic, "place-there", 0.55, clause_end},
    {"this", deictic, "object", 0.38},
    {"these", deictic, "object", 0.4},
    {"those", deictic, "object", 0.42},
    {"i", deictic, "self", 0.28, clause_start},
    {"me", deictic, "self", 0.4},
    {"myself", deictic, "self", 0.55},
    {"my", deictic, "self", 0.34},
    {"you", deictic, "partner", 0.36},
    {"your", deictic, "partner", 0.34},
    {"yourself", deictic, "partner", 0.5},
    {"all of you", deictic, "partner", 0.55},
    {"round", world, "shape-round", 0.72},
    {"around", world, "shape-round", 0.4},
    {"circle", world, "shape-round", 0.75},
    {"ball", world, "shape-round", 0.7},
    {"wheel", world, "shape-round", 0.65},
    {"flat", world, "shape-flat", 0.7},
    {"table", world, "shape-flat", 0.5},
    {"smooth", world, "shape-flat", 0.55},
    {"big", world, "size-big", 0.68},
    {"bigger", world, "size-big", 0.68},
    {"large", world, "size-big", 0.62},
    {"huge", world, "size-big", 0.78},
    {"enormous", world, "size-big", 0.8},
    {"giant", world, "size-big", 0.75},
    {"wide", world, "size-big", 0.65},
    {"whole", world, "size-big", 0.45},
    {"small", world, "size-small", 0.66},
    {"smaller", world, "size-small", 0.66},
    {"tiny", world, "size-small", 0.76},
    {"little", world, "size-small", 0.5},
    {"narrow", world, "size-small", 0.62},
    {"thin", world, "size-small", 0.6},
    {"one", world, "quantity-one", 0.45},
    {"once", world, "quantity-one", 0.42},
    {"two", world, "quantity-two", 0.6},
    {"both", world, "quantity-two", 0.52},
    {"three", world, "quantity-three", 0.62},
    {"all", world, "quantity-many", 0.48},
    {"every", world, "quantity-many", 0.45},
    {"everyone", world, "quantity-many", 0.5},
    {"everything", world, "quantity-many", 0.5},
    {"many", world, "quantity-many", 0.5},
    {"lots of", world, "quantity-many", 0.55},
    {"thousands", world, "quantity-many", 0.6},
    {"millions", world, "quantity-many", 0.62},
    {"up", world, "up", 0.42},
    {"upwards", world, "up", 0.58},
    {"above", world, "up", 0.52},
    {"higher", world, "up", 0.56},
    {"rises", world, "up", 0.58},
    {"down", world, "down", 0.42},
    {"downwards", world, "down", 0.58},
    {"below", world, "down", 0.52},
    {"lower", world, "down", 0.55},
    {"falls", world, "down", 0.56},
    {"yesterday", world, "time-past", 0.58},
    {"ago", world, "time-past", 0.5},
    {"in the past", world, "time-past", 0.6},
    {"back then", world, "time-past", 0.58},
    {"tomorrow", world, "time-future", 0.58},
    {"in the future", world, "time-future", 0.6},
    {"next year", world, "time-future", 0.52},
    {"next week", world, "time-future", 0.52},
    {"happy", emotion, "joy", 0.62},
    {"glad", emotion, "joy", 0.6},
    {"wonderful", emotion, "joy", 0.65},
    {"great", emotion, "joy", 0.45},
    {"love", emotion, "joy", 0.5},
    {"delighted", emotion, "joy", 0.68},
    {"beautiful", emotion, "joy", 0.52},
    {"fun", emotion, "joy", 0.48},
    {"sad", emotion, "sadness", 0.62},
    {"sadly", emotion, "sadness", 0.6},
    {"unfortunately", emotion, "sadness", 0.52},
    {"lonely", emotion, "sadness", 0.58},
    {"angry", emotion, "anger", 0.68},
    {"furious", emotion, "anger", 0.75},
    {"hate", emotion, "anger", 0.65},
    {"afraid", emotion, "fear", 0.62},
    {"scared", emotion, "fear", 0.65},
    {"terrified", emotion, "fear", 0.75},
    {"dangerous", emotion, "fear", 0.48},
    {"surprised", emotion, "surprise", 0.65},
    {"surprising", emotion, "surprise", 0.58},
    {"amazing", emotion, "surprise", 0.6},
    {"suddenly", emotion, "surprise", 0.52},
    {"incredible", emotion, "surprise", 0.6},
    {"disgusting", emotion, "disgust", 0.7},
    {"awful", emotion, "disgust", 0.55},
    {"horrible", emotion, "disgust", 0.6},
};

constexpr Cue kFrenchCues[] = {
    {"bonjour", performative, "greet", 0.9, clause_start},
    {"bonsoir", performative, "greet", 0.9, clause_start},
    {"salut", performative, "greet", 0.85, clause_start},
    {"bienvenue", performative, "greet", 0.85, clause_start},
    {"au revoir", performative, "goodbye", 0.9},
    {"à bientôt", performative, "goodbye", 0.85},
    {"adieu", performative, "goodbye", 0.9, clause_start},
    {"merci", performative, "thank", 0.8},
    {"je vous remercie", performative, "thank", 0.8},
    {"pardon", performative, "apologise", 0.7, clause_start},
    {"désolé", performative, "apologise", 0.75},
    {"désolée", performative, "apologise", 0.75},
    {"excusez-moi", performative, "apologise", 0.65},
    {"oui", performative, "agree", 0.65, clause_start},
    {"d'accord", performative, "agree", 0.62},
    {"exactement", performative, "agree", 0.65, clause_start},
    {"non", performative, "refuse", 0.7, clause_start},
    {"jamais", performative, "refuse", 0.58},
    {"pas du tout", performative, "refuse", 0.7},
    {"pas", performative, "refuse", 0.36},
    {"rien", performative, "refuse", 0.5},
    {"s'il vous plaît", performative, "order", 0.55},
    {"il faudrait", performative, "suggest", 0.5},
    {"vous devriez", performative, "suggest", 0.52},
    {"je propose", performative, "suggest", 0.55},
    {"bien sûr", certainty, "certain", 0.62},
    {"certainement", certainty, "certain", 0.6},
    {"évidemment", certainty, "certain", 0.6},
    {"absolument", certainty, "certain", 0.65},
    {"sans doute", certainty, "uncertain", 0.5},
    {"toujours", certainty, "certain", 0.45},
    {"peut-être", certainty, "uncertain", 0.62},
    {"probablement", certainty, "uncertain", 0.5},
    {"je ne sais pas", certainty, "uncertain", 0.72},
    {"qui sait", certainty, "uncertain", 0.72},
    {"mais", belief_relation, "contrast", 0.55, clause_start},
    {"cependant", belief_relation, "contrast", 0.65},
    {"pourtant", belief_relation, "contrast", 0.62},
    {"par contre", belief_relation, "contrast", 0.65},
    {"au contraire", belief_relation, "contrast", 0.7},
    {"d'un côté", belief_relation, "contrast", 0.75},
    {"de l'autre", belief_relation, "contrast", 0.75},
    {"parce que", belief_relation, "cause-effect", 0.5},
    {"car", belief_relation, "cause-effect", 0.45, clause_start},
    {"donc", belief_relation, "cause-effect", 0.5},
    {"c'est pourquoi", belief_relation, "cause-effect", 0.6},
    {"si", belief_relation, "condition", 0.42, clause_start},
    {"sinon", belief_relation, "condition", 0.5},
    {"par exemple", belief_relation, "elaborate", 0.52},
    {"en fait", belief_relation, "elaborate", 0.48},
    {"c'est-à-dire", belief_relation, "elaborate", 0.5},
    {"d'abord", belief_relation, "enumerate", 0.62},
    {"premièrement", belief_relation, "enumerate", 0.62},
    {"deuxièmement", belief_relation, "enumerate", 0.6},
    {"troisièmement", belief_relation, "enumerate", 0.58},
    {"ensuite", belief_relation, "enumerate", 0.55, clause_start},
    {"enfin", belief_relation, "enumerate", 0.52, clause_start},
    {"ici", deictic, "place-here", 0.6},
    {"là-bas", deictic, "place-there", 0.75},
    {"là", deictic, "place-there", 0.5},
    {"ceci", deictic, "object", 0.5},
    {"cela", deictic, "object", 0.42},
    {"je", deictic, "self", 0.28, clause_start},
    {"moi", deictic, "self", 0.5},
    {"vous", deictic, "partner", 0.36},
    {"toi", deictic, "partner", 0.5},
    {"rond", world, "shape-round", 0.72},
    {"ronde", world, "shape-round", 0.72},
    {"cercle", world, "shape-round", 0.75},
    {"autour", world, "shape-round", 0.5},
    {"plat", world, "shape-flat", 0.65},
    {"plate", world, "shape-flat", 0.65},
    {"grand", world, "size-big", 0.62},
    {"grande", world, "size-big", 0.62},
    {"gros", world, "size-big", 0.64},
    {"énorme", world, "size-big", 0.8},
    {"large", world, "size-big", 0.62},
    {"petit", world, "size-small", 0.62},
    {"petite", world, "size-small", 0.62},
    {"minuscule", world, "size-small", 0.76},
    {"étroit", world, "size-small", 0.62},
    {"deux", world, "quantity-two", 0.58},
    {"trois", world, "quantity-three", 0.6},
    {"tous", world, "quantity-many", 0.5},
    {"toutes", world, "quantity-many", 0.5},
    {"tout", world, "quantity-many", 0.46},
    {"beaucoup", world, "quantity-many", 0.52},
    {"en haut", world, "up", 0.6},
    {"monte", world, "up", 0.55},
    {"en bas", world, "down", 0.6},
    {"descend", world, "down", 0.55},
    {"hier", world, "time-past", 0.58},
    {"autrefois", world, "time-past", 0.6},
    {"demain", world, "time-future", 0.58},
    {"heureux", emotion, "joy", 0.62},
    {"heureuse", emotion, "joy", 0.62},
    {"content", emotion, "joy", 0.58},
    {"magnifique", emotion, "joy", 0.62},
    {"merveilleux", emotion, "joy", 0.65},
    {"triste", emotion, "sadness", 0.62},
    {"malheureusement", emotion, "sadness", 0.52},
    {"furieux", emotion, "anger", 0.75},
    {"colère", emotion, "anger", 0.65},
    {"peur", emotion, "fear", 0.62},
    {"dangereux", emotion, "fear", 0.5},
    {"surpris", emotion, "surprise", 0.62},
    {"incroyable", emotion, "surprise", 0.62},
    {"soudain", emotion, "surprise", 0.52},
    {"dégoûtant", emotion, "disgust", 0.7},
    {"horrible", emotion, "disgust", 0.6},
};

constexpr Cue kGermanCues[] = {
    {"hallo", performative, "greet", 0.9, clause_start},
    {"guten tag", performative, "greet", 0.9, clause_start},
    {"guten morgen", performative, "greet", 0.9, clause_start},
    {"guten abend", performative, "greet", 0.9, clause_start},
    {"willkommen", performative, "greet", 0.85, clause_start},
    {"herzlich willkommen", performative, "greet", 0.9, clause_start},
    {"auf wiedersehen", performative, "goodbye", 0.9},
    {"tschüss", performative, "goodbye", 0.9},
    {"gute nacht", performative, "goodbye", 0.9, clause_start},
    {"bis bald", performative, "goodbye", 0.85},
    {"danke", performative, "thank", 0.8},
    {"vielen dank", performative, "thank", 0.8},
    {"entschuldigung", performative, "apologise", 0.72},
    {"verzeihung", performative, "apologise", 0.72},
    {"tut mir leid", performative, "apologise", 0.75},
    {"ja", performative, "agree", 0.65, clause_start},
    {"genau", performative, "agree", 0.62, clause_start},
    {"einverstanden", performative, "agree", 0.65},
    {"stimmt", performative, "agree", 0.6, clause_start},
    {"nein", performative, "refuse", 0.7, clause_start},
    {"niemals", performative, "refuse", 0.68},
    {"nie", performative, "refuse", 0.55},
    {"nicht", performative, "refuse", 0.38},
    {"nichts", performative, "refuse", 0.52},
    {"kein", performative, "refuse", 0.4},
    {"keine", performative, "refuse", 0.4},
    {"überhaupt nicht", performative, "refuse", 0.7},
    {"bitte", performative, "order", 0.55, clause_start},
    {"wir sollten", performative, "suggest", 0.52},
    {"ich schlage vor", performative, "suggest", 0.55},
    {"lasst uns", performative, "suggest", 0.58, clause_start},
    {"natürlich", certainty, "certain", 0.6},
    {"selbstverständlich", certainty, "certain", 0.65},
    {"sicher", certainty, "certain", 0.5},
    {"bestimmt", certainty, "certain", 0.52},
    {"auf jeden fall", certainty, "certain", 0.62},
    {"immer", certainty, "certain", 0.45},
    {"vielleicht", certainty, "uncertain", 0.62},
    {"wahrscheinlich", certainty, "uncertain", 0.5},
    {"ich weiß nicht", certainty, "uncertain", 0.72},
    {"wer weiß", certainty, "uncertain", 0.72},
    {"aber", belief_relation, "contrast", 0.55, clause_start},
    {"jedoch", belief_relation, "contrast", 0.62},
    {"obwohl", belief_relation, "contrast", 0.52, clause_start},
    {"sondern", belief_relation, "contrast", 0.58, clause_start},
    {"einerseits", belief_relation, "contrast", 0.75},
    {"andererseits", belief_relation, "contrast", 0.78},
    {"trotzdem", belief_relation, "contrast", 0.6},
    {"weil", belief_relation, "cause-effect", 0.48},
    {"denn", belief_relation, "cause-effect", 0.45, clause_start},
    {"deshalb", belief_relation, "cause-effect", 0.6},
    {"deswegen", belief_relation, "cause-effect", 0.6},
    {"also", belief_relation, "cause-effect", 0.42, clause_start},
    {"wenn", belief_relation, "condition", 0.42, clause_start},
    {"sonst", belief_relation, "condition", 0.5},
    {"zum beispiel", belief_relation, "elaborate", 0.52},
    {"das heißt", belief_relation, "elaborate", 0.5},
    {"erstens", belief_relation, "enumerate", 0.62},
    {"zuerst", belief_relation, "enumerate", 0.6},
    {"zweitens", belief_relation, "enumerate", 0.6},
    {"drittens", belief_relation, "enumerate", 0.58},
    {"dann", belief_relation, "enumerate", 0.42, clause_start},
    {"schließlich", belief_relation, "enumerate", 0.52},
    {"hier", deictic, "place-here", 0.6},
    {"dort", deictic, "place-there", 0.62},
    {"da drüben", deictic, "place-there", 0.75},
    {"dieser", deictic, "object", 0.4},
    {"diese", deictic, "object", 0.38},
    {"dieses", deictic, "object", 0.4},
    {"ich", deictic, "self", 0.28, clause_start},
    {"mich", deictic, "self", 0.42},
    {"mir", deictic, "self", 0.4},
    {"sie alle", deictic, "partner", 0.55},
    {"ihnen", deictic, "partner", 0.36},
    {"dir", deictic, "partner", 0.4},
    {"dich", deictic, "partner", 0.42},
    {"rund", world, "shape-round", 0.72},
    {"runde", world, "shape-round", 0.7},
    {"kreis", world, "shape-round", 0.75},
    {"herum", world, "shape-round", 0.5},
    {"flach", world, "shape-flat", 0.7},
    {"flache", world, "shape-flat", 0.7},
    {"groß", world, "size-big", 0.64},
    {"große", world, "size-big", 0.62},
    {"großen", world, "size-big", 0.62},
    {"riesig", world, "size-big", 0.8},
    {"breit", world, "size-big", 0.64},
    {"klein", world, "size-small", 0.64},
    {"kleine", world, "size-small", 0.62},
    {"kleinen", world, "size-small", 0.62},
    {"winzig", world, "size-small", 0.76},
    {"schmal", world, "size-small", 0.62},
    {"zwei", world, "quantity-two", 0.58},
    {"beide", world, "quantity-two", 0.52},
    {"drei", world, "quantity-three", 0.6},
    {"alle", world, "quantity-many", 0.5},
    {"alles", world, "quantity-many", 0.48},
    {"viele", world, "quantity-many", 0.5},
    {"oben", world, "up", 0.58},
    {"hinauf", world, "up", 0.6},
    {"unten", world, "down", 0.58},
    {"hinunter", world, "down", 0.6},
    {"gestern", world, "time-past", 0.58},
    {"früher", world, "time-past", 0.52},
    {"damals", world, "time-past", 0.56},
    {"morgen", world, "time-future", 0.5},
    {"in zukunft", world, "time-future", 0.6},
    {"glücklich", emotion, "joy", 0.62},
    {"freue", emotion, "joy", 0.6},
    {"froh", emotion, "joy", 0.6},
    {"wunderbar", emotion, "joy", 0.65},
    {"schön", emotion, "joy", 0.46},
    {"traurig", emotion, "sadness", 0.62},
    {"leider", emotion, "sadness", 0.5},
    {"wütend", emotion, "anger", 0.72},
    {"hasse", emotion, "anger", 0.65},
    {"angst", emotion, "fear", 0.62},
    {"gefährlich", emotion, "fear", 0.5},
    {"überrascht", emotion, "surprise", 0.64},
    {"plötzlich", emotion, "surprise", 0.52},
    {"unglaublich", emotion, "surprise", 0.62},
    {"ekelhaft", emotion, "disgust", 0.7},
    {"schrecklich", emotion, "disgust", 0.58},
};

std::unordered_set<std::string_view> set_of(std::string_view list) {
    const std::vector<std::string_view> words = split_words(list);
    return {words.begin(), words.end()};
}

bool matches(const Cue& cue, std::span<const std::string> words, std::size_t at) {
    for (const std::string_view word : split_words(cue.phrase)) {
        if (at >= words.size() || words[at] != word) return false;
        ++at;
    }
    return true;
}

}  // namespace

const Vocabulary::Lists Vocabulary::kEnglish = {
    .function_words =
        "a an the this that these those i me my mine myself you your yours yourself he him his himself she "
        "her hers "
        "herself it its itself we us our ours ourselves they them their theirs themselves who whom whose "
        "which what "
        "when where why how and or but nor so yet if then than because as while although though unless until "
        "since of "
        "at by for with about against between into through during before after above below to from up down "
        "in out on "
        "off over under again further once here there all any both each few more most other some such no not "
        "only own "
        "same too very just also even still am is are was were be been being have has had having do does did "
        "doing "
        "will would shall should can could may might must ought let's i'm i've i'll i'd you're you've you'll "
        "you'd "
        "he's he'll he'd she's she'll she'd it's it'll we're we've we'll we'd they're they've they'll they'd "
        "that's "
        "there's here's what's who's where's how's isn't aren't wasn't weren't don't doesn't didn't can't "
        "couldn't "
        "won't wouldn't shouldn't haven't hasn't hadn't get got let one ones us upon onto across along "
        "around near "
        "like much many every everyone everything something anything nothing someone anyone nobody oh well "
        "yes now "
        "um uh er erm hmm mm ah",
    .auxiliaries =
        "am is are was were have has had do does did will would shall should can could may might must isn't "
        "aren't "
        "wasn't weren't don't doesn't didn't can't cannot couldn't won't wouldn't haven't hasn't",
    .conjunctions =
        "and but or so because although though while when if unless until which who whereas since",
    .imperatives =
        "look listen remember imagine think consider take try stop go come wait do don't never tell show "
        "give keep put "
        "make open close read say sit stand watch follow press turn bring call choose move be let leave "
        "start please",
    .question_words = "who whom whose which what when where why how",
    .hesitations = "um uh er erm hmm mm",
    .intensifiers = "very really so extremely totally completely incredibly absolutely quite too",
    .abbreviations = "mr mrs ms dr prof st vs etc e.g i.e no vol fig sr jr approx",
    .cues = kEnglishCues};

const Vocabulary::Lists Vocabulary::kFrench = {
    .function_words =
        "le la les l un une des du de d au aux ce cet cette ces mon ma mes ton ta tes son sa ses notre nos "
        "votre vos "
        "leur leurs je j tu il elle on nous vous ils elles me m te t se s lui eux moi toi soi y en qui que "
        "qu quoi dont "
        "où et ou mais donc or ni car si comme quand lorsque lorsqu puisque puisqu parce à dans par pour sur "
        "sous avec "
        "sans entre vers chez contre depuis pendant avant après ne n pas plus moins très aussi trop bien "
        "tout tous "
        "toute toutes même autre autres suis es est sommes êtes sont était étais étaient étions sera seront "
        "serait été "
        "être ai as a avons avez ont avait avais avaient aura auront aurait eu avoir fait faire peut peux "
        "peuvent "
        "pouvez pouvons doit dois doivent devez veut veux va vais vont allons allez c ça cela ceci ici là "
        "jusqu quelqu "
        "euh hum ben oui non alors puis",
    .auxiliaries =
        "suis es est sommes êtes sont était étaient sera seront serait ai as a avons avez ont avait avaient "
        "aura peut "
        "peuvent pouvez pouvons doit doivent devez veut va vais vont c'est n'est c'était",
    .conjunctions = "et mais ou donc car parce quand lorsque lorsque si qui que puisque comme où",
    .imperatives =
        "regardez regarde écoutez écoute imaginez imagine prenez prends venez viens attendez attends allez "
        "arrêtez "
        "pensez essayez dites donnez montrez lisez ouvrez fermez tournez choisissez suivez mettez faites",
    .question_words = "qui que quoi quand où est-ce pourquoi comment combien quel quelle quels quelles",
    .hesitations = "euh hum ben heu",
    .intensifiers = "très vraiment tellement extrêmement complètement absolument si trop",
    .abbreviations = "m mm mme mlle dr pr st ste etc p.ex vol fig",
    .cues = kFrenchCues};

const Vocabulary::Lists Vocabulary::kGerman = {
    .function_words =
        "der die das den dem des ein eine einen einem einer eines kein keine keinen keinem ich mich mir du "
        "dich dir er "
        "ihn ihm sie ihr ihnen es wir uns euch mein meine meinen meinem dein deine sein seine seinen ihre "
        "ihren unser "
        "unsere euer eure dieser diese dieses diesen diesem jener jene jenes wer wen wem wessen was welche "
        "welcher "
        "welches wann wo warum wie und oder aber denn sondern doch dass daß ob wenn weil als obwohl während "
        "bevor "
        "nachdem damit in im an am auf aus bei beim mit nach seit von vom zu zum zur für durch gegen ohne um "
        "über unter "
        "vor hinter neben zwischen bis nicht nur auch schon noch sehr so da dann hier dort mehr alle alles "
        "viele man "
        "sich selbst bin bist ist sind seid war waren wäre wird werden wurde wurden worden habe hast hat "
        "haben hatte "
        "hatten hätte kann kannst können konnte muss müssen soll sollen sollte will wollen darf dürfen mag "
        "möchte ja "
        "nein nun mal eben äh ähm hm",
    .auxiliaries =
        "bin bist ist sind seid war waren wäre wird werden wurde wurden habe hast hat haben hatte hatten "
        "kann kannst "
        "können konnte muss müssen soll sollen sollte will wollen darf dürfen mag möchte",
    .conjunctions = "und aber oder denn weil obwohl wenn dass daß sondern während als ob damit bevor nachdem",
    .imperatives =
        "schauen schau hören hör nehmen nimm stellen denken denk warten warte kommen komm gehen geh lesen "
        "öffnen "
        "schließen drehen wählen folgen zeigen geben sagen sehen",
    .question_words = "wer wen wem was welche welcher welches wann wo warum wie wieso wohin woher",
    .hesitations = "äh ähm hm",
    .intensifiers = "sehr wirklich so extrem total völlig absolut ganz zu",
    .abbreviations = "dr prof st hr fr z.b u.a d.h usw bzw ca nr vgl",
    .cues = kGermanCues};

Vocabulary::Vocabulary(const Lists& lists)
    : function_words_(set_of(lists.function_words)),
      auxiliaries_(set_of(lists.auxiliaries)),
      conjunctions_(set_of(lists.conjunctions)),
      imperatives_(set_of(lists.imperatives)),
      question_words_(set_of(lists.question_words)),
      hesitations_(set_of(lists.hesitations)),
      intensifiers_(set_of(lists.intensifiers)),
      abbreviations_(set_of(lists.abbreviations)),
      is_known_(!lists.cues.empty()) {
    for (const Words& words : {auxiliaries_, conjunctions_, question_words_, hesitations_})
        function_words_.insert(words.begin(), words.end());
    for (const Cue& cue : lists.cues) cues_[split_words(cue.phrase).front()].push_back(cue);
    for (auto& [first, cues] : cues_)
        std::stable_sort(cues.begin(), cues.end(),
                         [](const Cue& a, const Cue& b) { return length_of(a) > length_of(b); });
}

const Vocabulary& Vocabulary::of(std::string_view language) {
    static const Vocabulary english(kEnglish), french(kFrench), german(kGerman), other(Lists{});
    const std::string tongue = to_lower(language.substr(0, language.find_first_of("-_+")));
    if (tongue == "en" || tongue.empty()) return english;
    if (tongue == "fr") return french;
    if (tongue == "de") return german;
    return other;
}

bool Vocabulary::is_function_word(std::string_view word) const {
    if (!is_known_) return count_characters(word) <= 3;
    if (function_words_.contains(word)) return true;
    const std::size_t apostrophe = word.find('\'');
    if (apostrophe == std::string_view::npos) return false;
    // "l'homme", "qu'il": both parts must be function words; "John's": the first is none.
    return function_words_.contains(word.substr(0, apostrophe)) &&
           function_words_.contains(word.substr(apostrophe + 1));
}

const Cue* Vocabulary::cue_at(std::span<const std::string> words, std::size_t at) const {
    const auto found = cues_.find(words[at]);
    if (found == cues_.end()) return nullptr;
    for (const Cue& cue : found->second)
        if (matches(cue, words, at)) return &cue;
    return nullptr;
}

std::size_t length_of(const Cue& cue) {
    return static_cast<std::size_t>(std::count(cue.phrase.begin(), cue.phrase.end(), ' ')) + 1;
}

}  // namespace chironomia
