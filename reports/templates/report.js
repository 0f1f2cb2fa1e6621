// Draws the figures that turn or move; without scripts the printed views stand alone.
document.documentElement.classList.add("turnable");
JSON.parse(document.getElementById("interactive-data").textContent).forEach((figure, index) => {
  Plotly.newPlot("interactive-" + index, {
    data: figure.data,
    layout: figure.layout,
    frames: figure.frames ?? [],
    config: { responsive: true, displaylogo: false },
  });
});
