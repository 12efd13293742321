// SPDX-License-Identifier: MIT
//
// `check --claims`: every fact that a signal states is judged, a line a claim.
#ifndef BL_CLI_CLAIMS_H
#define BL_CLI_CLAIMS_H

#include "cli/verb.h"

// Runs the scorecard on the call's signal and keeps what is judged against its claims; the tests
// share `alpha`. Errors: BL_MISMATCH for a signal that states nothing.
bl_status bl_check_claims(bl_call *call, double alpha);

#endif
