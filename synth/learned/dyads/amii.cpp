#include "synth/learned/dyads/amii.h"

#include <cmath>

namespace chironomia {

using torch::Tensor;

namespace {

constexpr int64_t kWidth = AmiiParts::kWidth, kHeads = AmiiParts::kHeads;
constexpr int64_t kFace = 10, kSpeech = 16;

Tensor bent(const Tensor& x, bool tanh) {
    return tanh ? torch::tanh(x) : x;
}

Tensor last_of(const Tensor& z) {
    return z.narrow(1, z.size(1) - 1, 1);
}

// (B, T, c) -> (B, h, T, c / h)
Tensor split_heads(const Tensor& x) {
    return x.view({x.size(0), x.size(1), kHeads, kWidth / kHeads}).transpose(1, 2);
}

}  // namespace

AmiiAttentionImpl::AmiiAttentionImpl(bool adds)
    : query(register_module("query", torch::nn::Linear(kWidth, kWidth))),
      key(register_module("key", torch::nn::Linear(kWidth, kWidth))),
      value(register_module("value", torch::nn::Linear(kWidth, kWidth))),
      out(register_module("out", torch::nn::Linear(kWidth, kWidth))),
      residual(adds) {}

Tensor AmiiAttentionImpl::forward(const Tensor& from, const Tensor& to) {
    const double scale = 1 / std::sqrt(static_cast<double>(kWidth / kHeads));
    const Tensor likeness = torch::matmul(split_heads(query->forward(from) * scale),
                                          split_heads(key->forward(to)).transpose(-2, -1));
    const Tensor seen = torch::matmul(torch::softmax(likeness, -1), split_heads(value->forward(to)));
    const Tensor output = out->forward(seen.transpose(1, 2).flatten(2));
    return residual ? from + output : output;
}

ModalityEncoderImpl::ModalityEncoderImpl(int64_t inputs, const AmiiParts& parts)
    : before(register_module("before", torch::nn::Linear(inputs, kWidth))),
      after(register_module("after", torch::nn::Linear(kWidth, kWidth))),
      attention(register_module("attention", AmiiAttention(parts.residual))),
      parts_(parts) {
    if (!parts.has_memory()) return;
    memory =
        register_module("memory", torch::nn::LSTM(torch::nn::LSTMOptions(kWidth, kWidth).batch_first(true)));
}

Tensor ModalityEncoderImpl::forward(const Tensor& x) {
    const Tensor first = bent(before->forward(x), parts_.tanh);
    const Tensor second = bent(after->forward(attention->forward(first, first)), parts_.tanh);
    const Tensor states = parts_.has_memory() ? std::get<0>(memory->forward(second)) : second;
    return parts_.sequence ? states : last_of(states);
}

CrossEncoderImpl::CrossEncoderImpl(bool has_attention, const AmiiParts& parts)
    : join(register_module("join", torch::nn::Linear(2 * kWidth, kWidth))), tanh_(parts.tanh) {
    if (!has_attention) return;
    first = register_module("first", AmiiAttention(parts.residual));
    second = register_module("second", AmiiAttention(parts.residual));
}

Tensor CrossEncoderImpl::forward(const Sides& sides) {
    const Tensor a = first.is_empty() ? sides.a_from : first->forward(sides.a_from, sides.b);
    const Tensor b = first.is_empty() ? sides.b_from : second->forward(sides.b_from, sides.a);
    return bent(join->forward(torch::cat({a, b}, -1)), tanh_);
}

IntraEncoderImpl::IntraEncoderImpl(const AmiiParts& parts)
    : speech(register_module("speech", ModalityEncoder(kSpeech, parts))),
      face(register_module("face", ModalityEncoder(kFace, parts))),
      dual(register_module("dual", CrossEncoder(parts.has_dual(), parts))) {}

Tensor IntraEncoderImpl::forward(const PersonFrames& person) {
    const Tensor heard = speech->forward(person.speech), seen = face->forward(person.face);
    return dual->forward({.a_from = heard, .a = heard, .b_from = seen, .b = seen});
}

AmiiImpl::AmiiImpl(const AmiiParts& parts)
    : intra(register_module("intra", IntraEncoder(parts))), parts_(parts) {
    if (!parts.shared) intra_u = register_module("intra_u", IntraEncoder(parts));
    if (parts.has_inter()) inter = register_module("inter", CrossEncoder(true, parts));
    const int64_t people = parts.joint ? 2 : 1;
    const int64_t inputs = kWidth * (people + (parts.has_inter() ? 1 : 0));
    generator = register_module("generator", torch::nn::Linear(inputs, 2 * kFace));
    if (!parts.joint)
        person_generator = register_module("person_generator", torch::nn::Linear(2 * kFace, kFace));
}

Tensor AmiiImpl::encode_user(const PersonFrames& user) {
    return parts_.shared ? intra->forward(user) : intra_u->forward(user);
}

// Eq. (4). Only the last state of each encoding is used, so that only it is computed of the last encoder.
Tensor AmiiImpl::generate(const Tensor& z_a, const Tensor& z_u) {
    const Tensor last_a = last_of(z_a), last_u = last_of(z_u);
    std::vector<Tensor> between;
    if (parts_.has_inter())
        between.push_back(inter->forward({.a_from = last_a, .a = z_a, .b_from = last_u, .b = z_u}));
    const auto faces_of = [&](std::vector<Tensor> states) {
        states.insert(states.end(), between.begin(), between.end());
        return generator->forward(torch::cat(states, -1)).squeeze(1);
    };
    if (parts_.joint) return faces_of({last_a, last_u});
    return torch::cat({person_generator->forward(torch::relu(faces_of({last_a}))),
                       person_generator->forward(torch::relu(faces_of({last_u})))},
                      -1);
}

Tensor AmiiImpl::forward(const PersonFrames& a, const PersonFrames& u) {
    return generate(intra->forward(a), encode_user(u));
}

Tensor AmiiImpl::both_orders(const PersonFrames& people) {
    const Tensor z_a = intra->forward(people);
    const Tensor z_u = parts_.shared ? z_a : intra_u->forward(people);
    return generate(z_a, swapped_halves(z_u));
}

Tensor swapped_halves(const Tensor& x) {
    const int64_t half = x.size(0) / 2;
    return torch::cat({x.narrow(0, half, half), x.narrow(0, 0, half)}, 0);
}

}  // namespace chironomia
