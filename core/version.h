// SPDX-License-Identifier: MIT
#ifndef BL_CORE_VERSION_H
#define BL_CORE_VERSION_H

#define BL_VERSION "0.1.0" // the Makefile reads it here

#endif
