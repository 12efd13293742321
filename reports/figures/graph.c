// SPDX-License-Identifier: MIT
#include "reports/figures/graph.h"

void bl_graph_draw(bl_run *run, const bl_graph *graph) {
    const size_t count = graph->panels ? graph->panel_count : 1, each = graph->line_count / count;
    bl_column *columns = bl_run_memory(run, graph->line_count + 1, sizeof *columns);
    bl_series *series = bl_run_memory(run, graph->line_count, sizeof *series);
    bl_panel *panels = bl_run_memory(run, count, sizeof *panels);
    const char *file = bl_run_text(run, "%s.csv", graph->name);
    columns[0] = (bl_column){.name = graph->x_name, .values = graph->x};
    for (size_t i = 0; i < graph->line_count; i++) {
        const bl_line *line = &graph->lines[i];
        columns[i + 1] = (bl_column){.name = line->column, .values = line->values};
        series[i] = (bl_series){.stroke = line->stroke,
                                .ink = line->ink,
                                .file = file,
                                .x = graph->x_name,
                                .y = line->column,
                                .label = line->label};
    }
    for (size_t p = 0; p < count; p++)
        panels[p] = (bl_panel){.title = graph->panels ? graph->panels[p] : "",
                               .series = series + p * each,
                               .series_count = each};
    bl_plot plot = graph->plot;
    plot.panels = panels;
    plot.panel_count = count;
    bl_run_csv(run, graph->name, graph->what, columns, graph->line_count + 1, graph->points);
    bl_run_plot(run, graph->name, &plot, graph->alternative);
}
