// Draws the figures that can be turned; without scripts the printed views stand alone.
document.documentElement.classList.add("turnable");
JSON.parse(document.getElementById("interactive-data").textContent).forEach((figure, index) => {
  Plotly.newPlot("interactive-" + index, figure.data, figure.layout, {
    responsive: true,
    displaylogo: false,
  });
});
