// plotly.js with the two kinds of chart that the report draws.
import Plotly from 'plotly.js/lib/core';
import scatterpolar from 'plotly.js/lib/scatterpolar';

Plotly.register([scatterpolar]);
export default Plotly;
