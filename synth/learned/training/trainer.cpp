#include "synth/learned/training/trainer.h"

#include <ATen/Context.h>
#include <ATen/Parallel.h>
#include <dlfcn.h>
#include <torch/utils.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/learned/training/loss_curve.h"
#include "synth/learned/training/training_state.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

// ours: training between two checkpoints takes so many times as long as one
constexpr double kTimeOfASave = 20;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Seeds of their own for the order of every epoch and for the chance in every step.
Random order_of(const TrainingPlan& plan, std::size_t epoch) {
    return Random(plan.seed, 2 * epoch);
}

void seed_step(const TrainingPlan& plan, std::size_t step) {
    Random random(plan.seed, 2 * step + 1);
    const std::uint64_t high = random.next();
    torch::manual_seed(high << 32 | random.next());
}

Json to_json(const OptimiserKind& kind) {
    if (kind.rule == OptimiserKind::Rule::rmsprop)
        return {{"rule", "rmsprop"}, {"alpha", kind.alpha}, {"epsilon", kind.epsilon}};
    return {{"rule", "adam"}, {"beta1", kind.beta1}, {"beta2", kind.beta2}, {"epsilon", kind.epsilon}};
}

Json to_json(const LearningRate& rate) {
    constexpr const char* kNames[] = {"constant", "noam", "triangular", "warm_up", "exponential"};
    Json json{{"kind", kNames[static_cast<std::size_t>(rate.kind)]},
              {"peak", rate.peak},
              {"base", rate.base},
              {"warm_up", rate.warm_up},
              {"half_cycle", rate.half_cycle},
              {"factor", rate.factor},
              {"width", rate.width}};
    // Of this kind alone: trainings of the others go on from files that have no such fields.
    if (rate.kind == LearningRate::Kind::exponential) {
        json["decay"] = rate.decay;
        json["period"] = rate.period;
    }
    return json;
}

constexpr const char* kAnew = "name another file, or remove this one to train anew";

fs::path json_of(fs::path stem) {
    return stem += ".json";
}

// A file that no training wrote is neither gone on from nor written over.
void refuse_other_file(const fs::path& stem) {
    const fs::path json = json_of(stem);
    const Json found = read_json(json);
    const Json format_of_it = found.is_object() ? found.value("format", Json()) : Json();
    if (format_of_it.is_string() && format_of_it.get<std::string>().starts_with("chironomia checkpoint"))
        return;
    throw Error(
        format("{}: it describes no checkpoint, and that of {}.safetensors needs its place; name another "
               "checkpoint, or move this file",
               json.string(), stem.filename().string()));
}

// What must be the same for one training to go on where another ended.
Json identity(const TrainingTask& task, const TrainingPlan& plan, const Checkpoint& described) {
    return {{"model", described.model}, {"preset", described.preset}, {"options", described.options},
            {"seed", plan.seed},        {"examples", task.examples},  {"optimiser", to_json(plan.optimiser)},
            {"clip", plan.clip},        {"rate", to_json(plan.rate)}};
}

void check_same(const Json& asked, const Json& found, const fs::path& file) {
    for (const auto& [key, value] : asked.items()) {
        const Json other = found.is_object() ? found.value(key, Json()) : Json();
        if (other == value) continue;
        throw Error(format("{}: holds a training whose {} is {}, asked for is {}; {}", json_of(file).string(),
                           key, other.dump(), value.dump(), kAnew));
    }
}

// What the features reach from and to is taken from the training records: another corpus has other numbers.
void check_same_corpus(const std::vector<Feature>& asked, const std::vector<Feature>& found,
                       const fs::path& file) {
    for (std::size_t f = 0; f < std::min(asked.size(), found.size()); ++f) {
        if (asked[f].low == found[f].low && asked[f].high == found[f].high) continue;
        throw Error(format(
            "{}: holds a training on another corpus, in which {} reaches from {} to {}; in this one it "
            "reaches from {} to {}; {}",
            json_of(file).string(), asked[f].name, found[f].low, found[f].high, asked[f].low, asked[f].high,
            kAnew));
    }
}

// Files of earlier versions do not say what was learned.
void check_same_records(const std::string& asked, const Json& training, const fs::path& file) {
    const Json found = training.value("corpus", Json());
    if (asked.empty() || !found.is_string() || found == asked) return;
    throw Error(format(
        "{}: holds a training on other records: SHA-256 {:.8}..., those of this corpus have {:.8}...; {}",
        json_of(file).string(), found.get<std::string>(), asked, kAnew));
}

void check_not_longer(const TrainingState& done, const TrainingPlan& plan, const fs::path& file) {
    const std::size_t steps = plan.steps.value_or(done.step);
    if (done.step <= steps && done.epoch <= plan.epochs) return;
    const bool by_steps = done.step > steps;
    throw Error(format("{}: holds a training of {} {}, asked for is one of {}; ask for as many, or {}",
                       json_of(file).string(), by_steps ? done.step : done.epoch,
                       by_steps ? "steps" : "epochs", by_steps ? steps : plan.epochs, kAnew));
}

class Training {
  public:
    Training(const TrainingTask& task, const TrainingPlan& plan, const Checkpoint& described,
             const fs::path& file)
        : task_(task),
          plan_(plan),
          described_(described),
          stem_(checkpoint_stem(file)),
          optimiser_(plan.optimiser, *task.model),
          saved_(Clock::now()) {}

    TrainingResult run() {
        use_threads(plan_.threads);
        go_on_from_file();
        Progress progress("training", task_.unit, examples_to_go(), plan_.quiet);
        try {
            while (!is_done()) run_epoch(progress);
        } catch (const Interrupted&) {
            save(state_);
            throw;
        }
        // Training may end within an epoch. That state is validated too, but a later run resumes without it.
        const TrainingState end = state_.batch > 0 ? validated(state_) : state_;
        save(end);
        if (!end.best_weights.empty()) set_weights(*task_.model, end.best_weights, stem_);
        return {.steps = end.step,
                .train_loss = end.curve.empty() ? 0 : end.curve.back().train,
                .validation_loss = end.best,
                .curve = end.curve,
                .stopped_early = is_stale() || is_good_enough()};
    }

  private:
    bool is_stale() const { return plan_.patience && state_.stale >= *plan_.patience; }
    bool is_good_enough() const { return plan_.enough && state_.best <= *plan_.enough; }
    bool is_out_of_steps() const { return plan_.steps && state_.step >= *plan_.steps; }
    bool is_done() const {
        return state_.epoch >= plan_.epochs || is_out_of_steps() || is_stale() || is_good_enough();
    }

    bool is_time_to_save() const {
        if (plan_.save_every == 0) return true;
        return seconds_since(saved_) > std::max(plan_.save_every, kTimeOfASave * saving_);
    }

    std::size_t examples_to_go() const {
        const std::size_t epochs = plan_.epochs - std::min(state_.epoch, plan_.epochs);
        std::size_t left = epochs * task_.examples - std::min(epochs * task_.examples, state_.loss_count);
        if (plan_.steps) {
            Random random = order_of(plan_, 0);
            const std::size_t steps = *plan_.steps - std::min(state_.step, *plan_.steps);
            left = std::min(left, steps * task_.examples / task_.batches(random).size());
        }
        return left;
    }

    void begin_epoch() {
        if (task_.make_examples) {
            const torch::NoGradGuard no_gradients;
            task_.model->eval();
            if (state_.batch == 0) state_.made = task_.make_examples(state_.epoch);
            task_.use_examples(state_.epoch, state_.made);
        }
        task_.model->train();
    }

    void run_epoch(Progress& progress) {
        begin_epoch();
        Random random = order_of(plan_, state_.epoch);
        const std::vector<Batch> batches = task_.batches(random);
        while (state_.batch < batches.size()) {
            if (is_out_of_steps()) return;
            if (is_time_to_save()) save(state_);
            const Batch& batch = batches[state_.batch];
            state_.loss_sum += run_step(batch) * static_cast<double>(batch.size());
            state_.loss_count += batch.size();
            ++state_.batch;
            ++state_.step;
            progress.step(batch.size());
        }
        state_ = validated(state_);
        ++state_.epoch;
        state_.batch = state_.loss_count = 0;
        state_.loss_sum = 0;
        state_.made.clear();
    }

    double run_step(const Batch& batch) {
        seed_step(plan_, state_.step);
        if (task_.begin_step) task_.begin_step(state_.step);
        if (task_.adversary_loss) learn([&] { return task_.adversary_loss(batch); });
        return learn([&] { return task_.loss(batch); });
    }

    // One step of the optimiser against the gradients of a loss, which is returned.
    double learn(const std::function<torch::Tensor()>& loss_of) {
        const double rate = rate_at(plan_.rate, state_.step);
        optimiser_.forget_gradients();
        const torch::Tensor loss = loss_of();
        loss.backward();
        const double value = loss.item<double>();
        const double norm = optimiser_.gradient_norm();
        if (!std::isfinite(value) || !std::isfinite(norm)) {
            throw Error(
                format("{}: at step {} with the learning rate {} the loss is {} and the length of its "
                       "gradient {}; lower the rate or limit the gradient",
                       stem_.string(), state_.step, rate, value, norm));
        }
        if (plan_.clip > 0 && norm > plan_.clip) optimiser_.scale_gradients(plan_.clip / norm);
        optimiser_.step(rate);
        return value;
    }

    // The state with its validation loss, as one more point on the curve.
    TrainingState validated(TrainingState state) const {
        task_.model->eval();
        const torch::NoGradGuard no_gradients;
        const double validation = task_.validation_loss();
        if (!std::isfinite(validation)) {
            throw Error(format("{}: after step {} the loss of validation is {}; lower the learning rate",
                               stem_.string(), state.step, validation));
        }
        const double train = state.loss_sum / static_cast<double>(state.loss_count);
        state.curve.push_back({.step = state.step, .train = train, .validation = validation});
        ++state.stale;
        if (validation < state.best) {
            state.best = validation;
            state.best_weights = weights_of(*task_.model);
            state.stale = 0;
        }
        return state;
    }

    void go_on_from_file() {
        if (!fs::exists(json_of(stem_))) return;
        refuse_other_file(stem_);
        const StoredCheckpoint found = read_checkpoint(stem_, CheckpointParts::all);
        check_same(identity(task_, plan_, described_), found.description.training.value("identity", Json()),
                   stem_);
        check_same_corpus(described_.inputs, found.description.inputs, stem_);
        check_same_corpus(described_.outputs, found.description.outputs, stem_);
        check_same_records(plan_.corpus, found.description.training, stem_);
        state_ = training_state(found, *task_.model, optimiser_, stem_);
        check_not_longer(state_, plan_, stem_);
    }

    //   end  what is shown and used; training itself goes on from state_
    void save(const TrainingState& end) {
        const Clock::time_point begin = Clock::now();
        Checkpoint checkpoint = described_;
        checkpoint.seed = plan_.seed;
        checkpoint.step = state_.step;
        checkpoint.curve = end.curve;
        checkpoint.training = {{"identity", identity(task_, plan_, described_)}, {"state", to_json(state_)}};
        if (!plan_.corpus.empty())
            checkpoint.training.update({{"corpus", plan_.corpus}, {"split", plan_.split}});
        write_checkpoint(stem_,
                         {.description = std::move(checkpoint),
                          .weights = end.best_weights.empty() ? weights_of(*task_.model) : end.best_weights,
                          .resume = to_tensors(state_, *task_.model, optimiser_)});
        write_text(fs::path(stem_) += ".svg",
                   draw_loss_curve(format("{} {}", described_.model, described_.preset), end.curve));
        saved_ = Clock::now();
        saving_ = seconds_since(begin);
    }

    const TrainingTask& task_;
    const TrainingPlan& plan_;
    const Checkpoint& described_;
    fs::path stem_;
    Optimiser optimiser_;
    TrainingState state_;
    Clock::time_point saved_;
    double saving_ = 0;  // what the last checkpoint took [s]
};

}  // namespace

std::vector<Batch> shuffled_batches(std::size_t examples, std::size_t size, Random& random) {
    Batch order(examples);
    std::iota(order.begin(), order.end(), 0);
    random.shuffle(order);
    std::vector<Batch> batches;
    for (std::size_t begin = 0; begin < examples; begin += size) {
        const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
        batches.emplace_back(first, first + static_cast<std::ptrdiff_t>(std::min(size, examples - begin)));
    }
    return batches;
}

TrainingResult train(const TrainingTask& task, const TrainingPlan& plan, const Checkpoint& described,
                     const fs::path& file) {
    return Training(task, plan, described, file).run();
}

void use_threads(int threads) {
    at::set_num_threads(threads);
    // Not torch's to set: OpenBLAS with threads of its own would take every core.
    using SetThreads = void (*)(int);
    if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
        reinterpret_cast<SetThreads>(set)(threads);
    at::globalContext().setDeterministicAlgorithms(true, false);
    // oneDNN divides its loops, and so its sums, by the sizes of the processor's caches.
    at::globalContext().setUserEnabledMkldnn(false);
}

}  // namespace chironomia
