// SPDX-License-Identifier: MIT
//
// The files of a trade: its alternatives as a table, and cost against error as a plot.
#ifndef BL_REPORTS_TRADE_FILES_H
#define BL_REPORTS_TRADE_FILES_H

#include "core/table.h"
#include "reports/plot.h"
#include "score/trade.h"

// The alternatives as a table; valid as long as they are.
bl_table bl_trade_table(const bl_alternatives *alternatives);
// Those on the front in the order of their cost, in `rows`, which has room for all.
bl_table bl_trade_front(const bl_alternatives *alternatives, bl_alternative *rows);

// A plot and all that it points to.
typedef struct bl_trade_plot {
    bl_plot plot;
    bl_panel panel;
    bl_series series[3];
    char table[96], front[96], x_label[96], y_label[192];
} bl_trade_plot;

// Describes the plot of cost against error, both on logarithmic scales: NAME.csv has the
// alternatives, and NAME-front.csv those of the front, in the order of their cost. What has no
// error at all is not drawn. `plot` stays where it is while it is used.
void bl_trade_plot_describe(const bl_trade *trade, const bl_alternatives *alternatives,
                            const char *name, bl_trade_plot *plot);

// Writes NAME.csv, NAME-front.csv, NAME.gp, NAME.svg and NAME.png for a trade of this subject into
// the folder, which it makes. Errors: BL_DEVICE.
bl_status bl_trade_files_write(const bl_trade *trade, const char *subject,
                               const bl_alternatives *alternatives, const char *folder,
                               bl_message *message);

#endif
