// A preregistration out of a plan, item by item in the order of OSF's form.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/analysis/power.h"
#include "study/build/composition.h"
#include "study/plan/plan.h"

namespace chironomia::study {

// An item of the form. What the plan fixes stands beside what its people say.
struct PreregistrationItem {
    std::string section;             // "Design plan"
    std::string title;               // "Blinding"
    std::string key;                 // of "preregistration" in the plan; empty: the plan says it elsewhere
    std::vector<std::string> fixed;  // by the plan and the program, a sentence each
    std::vector<std::string> said;   // in the plan, a paragraph each
    std::string missing;             // what the plan does not say, and where it would; empty: it says all
};

struct Preregistration {
    std::string title;
    std::vector<PreregistrationItem> items;
    Json data;  // {"format": "chironomia preregistration 1", "program", "title", "plan_sha256", "items",
                //  "power", "plan"}
};

// What a participant of the plan answers, and the effect to find: `effect`, else the plan's, else the usual one. Throws
// Error if nothing is compared, as where one page question is asked of one pair of conditions.
analysis::PowerDesign power_design(const Plan& plan, const Composition& all, std::optional<double> effect,
                                   std::uint64_t seed);

// The items of Bowman, DeHaven, Errington, Hardwicke, Mellor, Nosek and Soderberg, "OSF Prereg Template", 2020
// (doi 10.31222/osf.io/epgjd), in their order. Nothing is added that neither the plan nor the program says: such an
// item has a text in `missing`. The power is simulated for the smallest effect that the plan names, or `effect`;
// without either there is none. The page is for everybody, so no seed of a study goes into it.
Preregistration make_preregistration(const Plan& plan, std::optional<double> effect);

// One HTML page that needs no other file, with the same as JSON in it.
std::string preregistration_page(const Preregistration& preregistration);

}  // namespace chironomia::study
