// SPDX-License-Identifier: MIT
//
// The list of all trades.
#include "score/trade.h"

#define BL_TRADE(stem) extern const bl_trade bl_trade_##stem;
#include "score/trades.def"
#undef BL_TRADE

static const void *const list[] = {
#define BL_TRADE(stem) &bl_trade_##stem,
#include "score/trades.def"
#undef BL_TRADE
};

const bl_registry bl_trades = {"trade", "trades", list, sizeof list / sizeof *list};
