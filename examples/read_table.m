% Reads a table that vibro-audit wrote, in MATLAB (R2016b or later) and Octave (7 or later): t.velocity is a column of
% numbers, or a cell array of words. t = read_table('rows.csv'), t = read_table('rows.json').
function t = read_table(path)
  text = fileread(path);
  if endsWith(path, '.json'), t = jsondecode(text); return; end   % a struct each row; NaN is a word
  lines = regexp(text, '("[^"]*"|[^"\n])+', 'match');             % a line break within quotes ends no line
  cells = @(line) regexprep(regexp(line, '(?<=^|,)("([^"]|"")*"|[^,"]*)(?=,|$)', 'match', 'emptymatch'), '^"|"$', '');
  names = cells(lines{1}); rows = cellfun(cells, lines(2:end), 'UniformOutput', false); rows = vertcat(rows{:}, cell(0, numel(names)));
  for k = 1:numel(names)
    words = strrep(rows(:, k), '""', '"'); numbers = str2double(words);
    if all(isfinite(numbers) | ismember(words, {'', 'NaN', 'inf', '-inf'})), t.(names{k}) = numbers; else, t.(names{k}) = words; end
  end
end
