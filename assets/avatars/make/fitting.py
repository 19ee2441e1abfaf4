"""Hangs proxies on a shaped base mesh, and carries weights and moves of the base mesh over to them."""

import numpy as np


def fitted(proxy, points):
    """(V, 3) [m] the vertices of a proxy on the base mesh `points`."""
    return carried(proxy, points) + proxy.offsets


def carried(proxy, values):
    """(V, ...) values of the base mesh's vertices, mixed as the proxy's vertices hang on them."""
    return np.einsum("vk,vk...->v...", proxy.shares, values[proxy.anchors])


def carried_weights(proxy, weights):
    """(V, J) joint weights; rows sum to 1."""
    mixed = np.clip(carried(proxy, weights), 0, None)
    return mixed / mixed.sum(1, keepdims=True)
