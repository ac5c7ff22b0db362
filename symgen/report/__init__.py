"""Reports: pages with pictures, tables and findings, from studies, as one HTML file or as Markdown."""
