#include "synth/learned/dyads/dyad_models.h"

#include <torch/utils.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "synth/learned/dyads/amii.h"

namespace chironomia {
namespace {

using torch::Tensor;

constexpr int64_t kCell = 64;

// (1, frames, columns) of the last frames of `rows`.
Tensor last_frames(std::span<const float> rows, int64_t columns, int64_t frames) {
    const auto count = static_cast<std::size_t>(columns * frames);
    return torch::from_blob(const_cast<float*>(rows.last(count).data()), {1, frames, columns});
}

FaceFrame face_in(const Tensor& row) {
    FaceFrame face{};
    std::copy_n(row.contiguous().data_ptr<float>(), face.size(), face.begin());
    return face;
}

// Both faces to A's next face. Woo, Fares, Pelachaud, Achard 2023, section 5.2, [15].
class FacesLstmImpl : public torch::nn::Module {
  public:
    FacesLstmImpl()
        : memory(register_module(
              "memory", torch::nn::LSTM(torch::nn::LSTMOptions(2 * kFaceColumns, kCell).batch_first(true)))),
          out(register_module("out", torch::nn::Linear(kCell, kFaceColumns))) {}

    Tensor forward(const Tensor& faces) {  // (B, T, 20) -> (B, 10)
        return out->forward(std::get<0>(memory->forward(faces)).select(1, faces.size(1) - 1));
    }

    torch::nn::LSTM memory;
    torch::nn::Linear out;
};
TORCH_MODULE(FacesLstm);

// All of both people to both next faces. The same, [20].
class SymmetricLstmImpl : public torch::nn::Module {
  public:
    using State = std::tuple<Tensor, Tensor>;

    SymmetricLstmImpl()
        : memory(register_module(
              "memory", torch::nn::LSTM(torch::nn::LSTMOptions(2 * (kFaceColumns + kSpeechColumns), kCell)
                                            .num_layers(2)
                                            .batch_first(true)))),
          out(register_module("out", torch::nn::Linear(kCell, 2 * kFaceColumns))) {}

    Tensor forward(const Tensor& frames) {  // (B, T, 52) -> (B, 20)
        return out->forward(std::get<0>(memory->forward(frames)).select(1, frames.size(1) - 1));
    }

    static State zero(int64_t batch) {
        return {torch::zeros({2, batch, kCell}), torch::zeros({2, batch, kCell})};
    }

    // The same, going on from `state`, which becomes that after these frames.
    Tensor go_on(const Tensor& frames, State& state) {
        auto [states, end] = memory->forward(frames, state);
        state = std::move(end);
        return out->forward(states.select(1, frames.size(1) - 1));
    }

    torch::nn::LSTM memory;
    torch::nn::Linear out;
};
TORCH_MODULE(SymmetricLstm);

PersonFrames swapped(const PersonFrames& people) {
    return {.face = swapped_halves(people.face), .speech = swapped_halves(people.speech)};
}

PersonFrames newest(const PersonFrames& people) {
    return {.face = people.face.narrow(1, people.face.size(1) - 1, 1),
            .speech = people.speech.narrow(1, people.speech.size(1) - 1, 1)};
}

Tensor faces_of(const PersonFrames& a, const PersonFrames& u) {
    return torch::cat({a.face, u.face}, -1);
}

Tensor all_of(const PersonFrames& a, const PersonFrames& u) {
    return torch::cat({a.face, a.speech, u.face, u.speech}, -1);
}

Tensor all_of(const DyadPast& past, int64_t frames) {
    return torch::cat(
        {last_frames(past.a_face, kFaceColumns, frames), last_frames(past.a_speech, kSpeechColumns, frames),
         last_frames(past.u_face, kFaceColumns, frames), last_frames(past.u_speech, kSpeechColumns, frames)},
        -1);
}

// Frame by frame by whole windows; memories start from nothing in each, as in training.
DyadStep step_by(const DyadSteps& beside) {
    return [beside](const DyadPast& past, bool /*restarted*/) {
        const torch::InferenceMode inference;
        const auto newest_window = [](std::span<const float> face, std::span<const float> speech) {
            return PersonFrames{.face = last_frames(face, kFaceColumns, kWindowFrames),
                                .speech = last_frames(speech, kSpeechColumns, kWindowFrames)};
        };
        return face_in(
            beside(newest_window(past.a_face, past.a_speech), newest_window(past.u_face, past.u_speech))[0]);
    };
}

DyadModel faces_lstm() {
    FacesLstm model;
    const DyadSteps beside = [model](const PersonFrames& a, const PersonFrames& u) mutable {
        return model->forward(faces_of(a, u));
    };
    return {.module = model.get(),
            .parts = Json::object(),
            .predict = [beside](const PersonFrames& people) { return beside(people, swapped(people)); },
            .predict_beside = beside,
            .start = [beside] { return step_by(beside); },
            .start_many = [beside] { return beside; }};
}

DyadModel symmetric_lstm() {
    SymmetricLstm model;
    const auto start = [model]() -> DyadStep {
        const torch::InferenceMode inference;
        return [model = SymmetricLstm(model), state = SymmetricLstmImpl::State()](const DyadPast& past,
                                                                                  bool restarted) mutable {
            const torch::InferenceMode inference;
            if (restarted) state = SymmetricLstmImpl::zero(1);
            return face_in(model->go_on(all_of(past, restarted ? kWindowFrames : 1), state)[0].narrow(
                0, 0, kFaceColumns));
        };
    };
    const auto start_many = [model]() -> DyadSteps {
        return [model = SymmetricLstm(model), state = std::optional<SymmetricLstmImpl::State>()](
                   const PersonFrames& a, const PersonFrames& u) mutable {
            const bool begins = !state;
            if (begins) state = SymmetricLstmImpl::zero(a.face.size(0));
            const Tensor frames = begins ? all_of(a, u) : all_of(newest(a), newest(u));
            return model->go_on(frames, *state).narrow(1, 0, kFaceColumns);
        };
    };
    const DyadSteps beside = [model](const PersonFrames& a, const PersonFrames& u) mutable {
        return model->forward(all_of(a, u));
    };
    return {.module = model.get(),
            .parts = Json::object(),
            .predict = [beside](const PersonFrames& people) { return beside(people, swapped(people)); },
            .predict_beside = beside,
            .start = start,
            .start_many = start_many};
}

DyadModel amii(const AmiiParts& parts) {
    Amii model(parts);
    const DyadSteps beside = [model](const PersonFrames& a, const PersonFrames& u) mutable {
        return model->forward(a, u);
    };
    const DyadSteps next_of_a = [beside](const PersonFrames& a, const PersonFrames& u) {
        return beside(a, u).narrow(1, 0, kFaceColumns);
    };
    return {.module = model.get(),
            .parts = to_json(parts),
            .predict = [model](const PersonFrames& people) mutable { return model->both_orders(people); },
            .predict_beside = beside,
            .start = [next_of_a] { return step_by(next_of_a); },
            .start_many = [next_of_a] { return next_of_a; }};
}

}  // namespace

DyadModel make_dyad_model(const std::string& name, const std::string& preset, const JsonValue& options,
                          std::uint64_t seed) {
    std::vector<std::string> known{"stride",   "batch", "epochs",   "peak",        "base",    "cycle",
                                   "patience", "clip",  "own_past", "own_seconds", "own_from"};
    if (name == "amii") known.insert(known.end(), {"ablation", "A08", "A25", "A26", "A27"});
    options.allow_only(known);
    torch::manual_seed(seed);
    if (name == "amii") return amii(amii_parts(preset, options));
    return name == "il-lstm" ? faces_lstm() : symmetric_lstm();
}

}  // namespace chironomia
