#include "synth/markup/vocabulary_lists.h"

namespace chironomia {
namespace {

using enum MarkKind;
using enum CuePlace;

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

}  // namespace

const VocabularyLists kGerman = {
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

}  // namespace chironomia
