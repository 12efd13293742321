// SPDX-License-Identifier: MIT
//
// Gauss-Legendre quadrature on [-1, 1] with 16 nodes: exact for polynomials of degree 31.
#ifndef BL_CORE_QUADRATURE_H
#define BL_CORE_QUADRATURE_H

enum { BL_QUADRATURE_NODES = 16 };

// In increasing order of the nodes; the weights sum to 2.
extern const double bl_quadrature_node[BL_QUADRATURE_NODES];
extern const double bl_quadrature_weight[BL_QUADRATURE_NODES];

#endif
