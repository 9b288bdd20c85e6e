#include "contact/enforce/node_states.hpp"

#include <algorithm>
#include <cstring>

namespace abut::contact {

const NodeState& plain_state(Remembered what) {
  static const NodeState nothing;
  static const NodeState seen_in_front = [] {
    NodeState state;
    state.in_front = 1;
    return state;
  }();
  return what == Remembered::seen_in_front ? seen_in_front : nothing;
}

Remembered remembered(const NodeState& state) {
  if (state.facet != no_index) return Remembered::all;
  const Remembered what = state.in_front != 0 ? Remembered::seen_in_front : Remembered::nothing;
  return std::memcmp(&state, &plain_state(what), sizeof state) == 0 ? what : Remembered::all;
}

NodeStates::NodeStates(std::size_t nodes)
    : pages_((nodes + group - 1) / group), full_(pages_.size()), before_(nodes, Remembered::nothing), after_(nodes, Remembered::nothing) {}

void NodeStates::give_full(std::size_t group_number) {
  full_[group_number] = std::make_unique<NodeState[]>(2 * static_cast<std::size_t>(group));
  Page& page = pages_[group_number];
  page = {full_[group_number].get(), full_[group_number].get() + group};
  const std::size_t first = group_number * group;
  for (std::size_t i = first; i < std::min(first + group, size()); ++i) {
    page.before[i - first] = plain_state(before_[i]);
    page.after[i - first] = plain_state(after_[i]);
  }
}

void NodeStates::set(Index i, const NodeState& state) {
  const std::size_t g = number(i);
  const Remembered what = remembered(state);
  if (full_[g] == nullptr && what == Remembered::all) give_full(g);
  if (full_[g] != nullptr) {
    pages_[g].before[place(i)] = pages_[g].after[place(i)] = state;
  } else {
    before_[static_cast<std::size_t>(i)] = after_[static_cast<std::size_t>(i)] = what;
  }
}

void NodeStates::commit() {
  for (Page& page : pages_) std::swap(page.before, page.after);
  before_.swap(after_);
}

NodeStates::Loan::Loan(NodeStates& states, std::size_t group, Scratch& scratch)
    : states_(states), group_(group), lent_(states.full_[group] == nullptr) {
  if (lent_) states_.pages_[group_] = {scratch.before.data(), scratch.after.data()};
}

NodeStates::Loan::~Loan() {
  if (lent_) states_.pages_[group_] = {};
}

void NodeStates::Loan::wake(Index i) {
  if (lent_) states_.pages_[group_].before[place(i)] = plain_state(states_.before_[static_cast<std::size_t>(i)]);
}

void NodeStates::Loan::settle(std::span<const Index> nodes) {
  if (!lent_) return;
  const NodeState* lent = states_.pages_[group_].after;
  bool plain = true;
  for (const Index i : nodes) {
    const Remembered what = remembered(lent[place(i)]);
    states_.after_[static_cast<std::size_t>(i)] = what;
    plain = plain && what != Remembered::all;
  }
  if (plain) return;
  states_.give_full(group_);
  lent_ = false;
  for (const Index i : nodes) states_.pages_[group_].after[place(i)] = lent[place(i)];
}

}  // namespace abut::contact
