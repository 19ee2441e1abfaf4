#include "synth/learned/dyad_models.h"

#include <torch/utils.h>

#include <algorithm>
#include <utility>

#include "synth/learned/amii_runner.h"

namespace chironomia {
namespace {

using torch::Tensor;

constexpr int64_t kFace = DyadPerson::kFace, kSpeech = DyadPerson::kSpeech, kWindow = AmiiParts::kWindow;
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
              "memory", torch::nn::LSTM(torch::nn::LSTMOptions(2 * kFace, kCell).batch_first(true)))),
          out(register_module("out", torch::nn::Linear(kCell, kFace))) {}

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
              "memory",
              torch::nn::LSTM(
                  torch::nn::LSTMOptions(2 * (kFace + kSpeech), kCell).num_layers(2).batch_first(true)))),
          out(register_module("out", torch::nn::Linear(kCell, 2 * kFace))) {}

    Tensor forward(const Tensor& frames) {  // (B, T, 52) -> (B, 20)
        return out->forward(std::get<0>(memory->forward(frames)).select(1, frames.size(1) - 1));
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

Tensor all_of(const PersonFrames& people) {
    return torch::cat(
        {people.face, people.speech, swapped_halves(people.face), swapped_halves(people.speech)}, -1);
}

Tensor all_of(const DyadPast& past, int64_t frames) {
    return torch::cat({last_frames(past.a_face, kFace, frames), last_frames(past.a_speech, kSpeech, frames),
                       last_frames(past.u_face, kFace, frames), last_frames(past.u_speech, kSpeech, frames)},
                      -1);
}

DyadModel faces_lstm() {
    FacesLstm model;
    const auto step = [model](const DyadPast& past, bool /*restarted*/) mutable {
        const torch::InferenceMode inference;
        const Tensor faces = torch::cat(
            {last_frames(past.a_face, kFace, kWindow), last_frames(past.u_face, kFace, kWindow)}, -1);
        return face_in(model->forward(faces)[0]);
    };
    return {.module = model.get(),
            .parts = Json::object(),
            .predict =
                [model](const PersonFrames& people) mutable {
                    return model->forward(torch::cat({people.face, swapped_halves(people.face)}, -1));
                },
            .start = [step] { return step; }};
}

DyadModel symmetric_lstm() {
    SymmetricLstm model;
    const auto start = [model]() -> DyadStep {
        const torch::InferenceMode inference;
        SymmetricLstmImpl::State zero{torch::zeros({2, 1, kCell}), torch::zeros({2, 1, kCell})};
        return [model = SymmetricLstm(model), zero, state = zero](const DyadPast& past,
                                                                  bool restarted) mutable {
            const torch::InferenceMode inference;
            if (restarted) state = zero;
            return face_in(model->go_on(all_of(past, restarted ? kWindow : 1), state)[0].narrow(0, 0, kFace));
        };
    };
    return {.module = model.get(),
            .parts = Json::object(),
            .predict = [model](const PersonFrames& people) mutable { return model->forward(all_of(people)); },
            .start = start};
}

DyadModel amii(const AmiiParts& parts) {
    Amii model(parts);
    return {.module = model.get(),
            .parts = to_json(parts),
            .predict = [model](const PersonFrames& people) mutable { return model->both_orders(people); },
            .start = [model] { return start_amii(model); }};
}

}  // namespace

std::vector<std::string> dyad_model_names() {
    return {"amii", "il-lstm", "sym-il-lstm"};
}

DyadModel make_dyad_model(const std::string& name, const std::string& preset, const JsonValue& options,
                          std::uint64_t seed) {
    std::vector<std::string> known{"stride", "batch", "epochs", "peak", "base", "cycle", "patience", "clip"};
    if (name == "amii") known.insert(known.end(), {"ablation", "A08", "A25", "A26", "A27"});
    options.allow_only(known);
    torch::manual_seed(seed);
    if (name == "amii") return amii(amii_parts(preset, options));
    return name == "il-lstm" ? faces_lstm() : symmetric_lstm();
}

}  // namespace chironomia
