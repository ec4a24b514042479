% Reads what the commands write, as examples/read_table.m does, and holds CSV against JSON.
addpath('examples');
command = ['target/debug/vibro-audit ' '%s --format %s --out target/octave.%s'];
for asked = {'sweep fig03 --set sweep.points=5', 'audit'}
  for format = {'csv', 'json'}
    assert(system(sprintf(command, asked{1}, format{1}, format{1})) == 0);
  end
  t = read_table('target/octave.csv'); j = read_table('target/octave.json');
  if isstruct(j), j = num2cell(j); end
  names = fieldnames(t);
  for k = 1:numel(names)
    own = t.(names{k});
    if isnumeric(own)
      % jsondecode of Octave may lose the last bit
      other = cellfun(@(row) [row.(names{k}), NaN](1), j);
      assert(own(:), other(:), -1e-15);
    end
  end
  assert(numel(t.(names{1})) == numel(j));
end
t = read_table('target/octave.csv');
assert(strcmp(t.verdict{1}, 'proved') && any(strcmp(t.verdict, 'refuted')));
disp('read_table.m reads CSV and JSON of the commands in Octave');
