#include "synth/markup/vocabulary_lists.h"

namespace chironomia {
namespace {

using enum MarkKind;
using enum CuePlace;

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

}  // namespace

const VocabularyLists kFrench = {
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

}  // namespace chironomia
