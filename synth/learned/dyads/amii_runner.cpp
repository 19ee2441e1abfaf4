#include "synth/learned/dyads/amii_runner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "synth/learned/dyads/amii_kernels.h"

namespace chironomia {
namespace {

DenseLayer dense_of(const torch::Tensor& weight, const torch::Tensor& bias) {
    const torch::Tensor turned_weight = weight.detach().t().contiguous(), plain = bias.detach().contiguous();
    const float *w = turned_weight.data_ptr<float>(), *b = plain.data_ptr<float>();
    return {.inputs = static_cast<std::size_t>(weight.size(1)),
            .outputs = static_cast<std::size_t>(weight.size(0)),
            .weight = std::vector<float>(w, w + weight.numel()),
            .bias = std::vector<float>(b, b + bias.numel())};
}

DenseLayer dense_of(const torch::nn::Linear& linear) {
    return dense_of(linear->weight, linear->bias);
}

struct Attention {
    explicit Attention(const AmiiAttention& from)
        : query(dense_of(from->query)),
          key(dense_of(from->key)),
          value(dense_of(from->value)),
          out(dense_of(from->out)),
          residual(from->residual) {
        const float scale = 1 / std::sqrt(static_cast<float>(AmiiParts::kWidth / AmiiParts::kHeads));
        for (float& number : query.weight) number *= scale;
        for (float& number : query.bias) number *= scale;
    }

    AmiiState attention_of(const AmiiState& from, const AmiiKeys& to) const {
        AmiiState q;
        query.apply(from.data(), q.data());
        return project(from, attend(q, to));
    }

    // The output projection, with the residual connection.
    AmiiState project(const AmiiState& from, const AmiiState& seen) const {
        AmiiState state;
        out.apply(seen.data(), state.data());
        if (!residual) return state;
        for (std::size_t i = 0; i < state.size(); ++i) state[i] += from[i];
        return state;
    }

    AmiiKeys keys_of(const AmiiRows& rows) const {
        AmiiRows keys;
        AmiiKeys result;
        for (std::size_t t = 0; t < kAmiiWindow; ++t) {
            key.apply(rows[t].data(), keys[t].data());
            value.apply(rows[t].data(), result.values[t].data());
        }
        result.keys = transposed(keys);
        return result;
    }

    DenseLayer query, key, value, out;
    bool residual;
};

struct Modality {
    Modality(const ModalityEncoder& from, const AmiiParts& parts)
        : before(dense_of(from->before)),
          after(dense_of(from->after)),
          attention(from->attention),
          tanh(parts.tanh) {
        if (!parts.has_memory()) return;
        const auto weights = from->memory->named_parameters();
        const torch::Tensor recurrent = weights["weight_hh_l0"].detach().t().contiguous();
        memory = LstmLayer{
            .input = dense_of(weights["weight_ih_l0"], weights["bias_ih_l0"] + weights["bias_hh_l0"]),
            .recurrent = {recurrent.data_ptr<float>(), recurrent.data_ptr<float>() + recurrent.numel()}};
    }

    DenseLayer before, after;
    Attention attention;
    std::optional<LstmLayer> memory;
    bool tanh;
};

// The frames that one modality of one person has in the window, as far as they do not depend on it.
struct ModalityWindow {
    AmiiRows firsts, queries;
    AmiiKeys seen;

    void push(const Modality& encoder, const float* frame) {
        AmiiState first, state;
        encoder.before.apply(frame, first.data());
        if (encoder.tanh) apply_tanh(first);
        forget_oldest(firsts, first);
        encoder.attention.query.apply(first.data(), state.data());
        forget_oldest(queries, state);
        encoder.attention.key.apply(first.data(), state.data());
        forget_oldest(seen.keys, state);
        encoder.attention.value.apply(first.data(), state.data());
        forget_oldest(seen.values, state);
    }

    AmiiRows encoded(const Modality& encoder) const {
        AmiiRows rows;
        for (std::size_t t = 0; t < kAmiiWindow; ++t) {
            const AmiiState state = encoder.attention.project(firsts[t], attend(queries[t], seen));
            encoder.after.apply(state.data(), rows[t].data());
            if (encoder.tanh) apply_tanh(rows[t]);
        }
        if (encoder.memory) encoder.memory->apply(rows);
        return rows;
    }
};

// E_dual and E_inter.
struct Crossing {
    Crossing(const CrossEncoder& from, bool has_tanh) : join(dense_of(from->join)), tanh(has_tanh) {
        if (from->first.is_empty()) return;
        first.emplace(from->first);
        second.emplace(from->second);
    }

    AmiiState joined(const AmiiState& a, const AmiiState& b) const {
        std::array<float, 2 * kAmiiWidth> both;
        std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), both.begin()));
        AmiiState state;
        join.apply(both.data(), state.data());
        if (tanh) apply_tanh(state);
        return state;
    }

    AmiiRows over(const AmiiRows& a, const AmiiRows& b) const {
        AmiiRows rows;
        if (!first) {
            for (std::size_t t = 0; t < kAmiiWindow; ++t) rows[t] = joined(a[t], b[t]);
            return rows;
        }
        const AmiiKeys of_b = first->keys_of(b), of_a = second->keys_of(a);
        for (std::size_t t = 0; t < kAmiiWindow; ++t)
            rows[t] = joined(first->attention_of(a[t], of_b), second->attention_of(b[t], of_a));
        return rows;
    }

    AmiiState of_last(const AmiiRows& a, const AmiiRows& b) const {
        return joined(first->attention_of(a.back(), first->keys_of(b)),
                      second->attention_of(b.back(), second->keys_of(a)));
    }

    std::optional<Attention> first, second;
    DenseLayer join;
    bool tanh;
};

struct Intra {
    Intra(const IntraEncoder& from, const AmiiParts& parts)
        : speech(from->speech, parts), face(from->face, parts), dual(from->dual, parts.tanh) {}

    Modality speech, face;
    Crossing dual;
};

struct PersonWindow {
    ModalityWindow speech, face;

    void push(const Intra& intra, const float* speech_frame, const float* face_frame) {
        speech.push(intra.speech, speech_frame);
        face.push(intra.face, face_frame);
    }

    AmiiRows encoded(const Intra& intra) const {
        return intra.dual.over(speech.encoded(intra.speech), face.encoded(intra.face));
    }
};

class AmiiRunner {
  public:
    explicit AmiiRunner(const AmiiImpl& model)
        : intra_a_(model.intra, model.parts()),
          intra_u_(model.parts().shared ? model.intra : model.intra_u, model.parts()),
          generator_(dense_of(model.generator)) {
        if (model.parts().has_inter()) inter_.emplace(model.inter, model.parts().tanh);
        if (!model.parts().joint) person_generator_ = dense_of(model.person_generator);
    }

    FaceFrame next(const DyadPast& past, bool restarted) {
        const std::size_t frames = past.frames();
        for (std::size_t t = frames - (restarted ? kAmiiWindow : 1); t < frames; ++t) {
            a_.push(intra_a_, &past.a_speech[t * kSpeechColumns], &past.a_face[t * kFaceColumns]);
            u_.push(intra_u_, &past.u_speech[t * kSpeechColumns], &past.u_face[t * kFaceColumns]);
        }
        const AmiiRows z_a = a_.encoded(intra_a_), z_u = u_.encoded(intra_u_);
        std::vector<float> states(z_a.back().begin(), z_a.back().end());
        if (!person_generator_) states.insert(states.end(), z_u.back().begin(), z_u.back().end());
        if (inter_) {
            const AmiiState between = inter_->of_last(z_a, z_u);
            states.insert(states.end(), between.begin(), between.end());
        }
        return face_of(states);
    }

  private:
    FaceFrame face_of(const std::vector<float>& states) const {
        std::array<float, 2 * kFaceColumns> both;
        generator_.apply(states.data(), both.data());
        FaceFrame face;
        if (person_generator_) {
            for (float& number : both) number = std::max(number, 0.0f);
            person_generator_->apply(both.data(), face.data());
        } else {
            std::copy_n(both.begin(), kFaceColumns, face.begin());
        }
        return face;
    }

    Intra intra_a_, intra_u_;
    std::optional<Crossing> inter_;
    DenseLayer generator_;
    std::optional<DenseLayer> person_generator_;
    PersonWindow a_, u_;
};

torch::Tensor window_of(std::span<const float> rows, std::size_t columns) {
    return torch::from_blob(const_cast<float*>(rows.last(columns * kAmiiWindow).data()),
                            {1, static_cast<int64_t>(kAmiiWindow), static_cast<int64_t>(columns)});
}

}  // namespace

DyadStep start_amii_with_torch(const Amii& model) {
    return [model = Amii(model)](const DyadPast& past, bool /*restarted*/) mutable {
        const torch::InferenceMode inference;
        const torch::Tensor next = model->forward({.face = window_of(past.a_face, kFaceColumns),
                                                   .speech = window_of(past.a_speech, kSpeechColumns)},
                                                  {.face = window_of(past.u_face, kFaceColumns),
                                                   .speech = window_of(past.u_speech, kSpeechColumns)});
        FaceFrame face;
        std::copy_n(next.contiguous().data_ptr<float>(), kFaceColumns, face.begin());
        return face;
    };
}

DyadStep start_amii(const Amii& model) {
    if (!model->parts().sequence) return start_amii_with_torch(model);
    return [runner = AmiiRunner(*model)](const DyadPast& past, bool restarted) mutable {
        return runner.next(past, restarted);
    };
}

}  // namespace chironomia
