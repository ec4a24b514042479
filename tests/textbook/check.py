#!/usr/bin/env python3
"""Builds NAME.toml from NAME.txt and checks every claim numerically.
usage: check.py integrals|limits|sums
Line: R|W ;; source ;; tex ;; assume (separated by ,, ) ;; left (python) ;; right (python)
left of integrals:  f @x a,b[,c...]   (mpmath.quad over x);  else an expression
left of limits:     f @x->p[+-]       ;  right: value | inf | -inf | O | o  (for O and o, f is remainder/order)
left of sums:       f #k lo,hi (sum)  f ##k lo,hi (product); else an expression
right: value, or '< v' '<= v' '> v' '>= v', or '~ 0.123' (half a unit of the last figure)
"""
import sys, re, random, itertools, json, os
import mpmath as MM; from mpmath import mp
from mpmath import mpf
NAME=sys.argv[1]
HERE=os.path.dirname(os.path.abspath(__file__))
INTS={'integrals':['n','m','k'],'limits':['n','k','m'],'sums':['n','k','m','j','N','r','s']}[NAME]
POS={'integrals':['p','q'],'limits':['p','q'],'sums':[]}[NAME]
REALS=['a','b','c','x','y','p','q','t','u','s','r','R','T','h','L','z','al','be','om','th','si','mu','w','A','B','la','v']
GRK={'al':r'\alpha','be':r'\beta','om':r'\omega','th':r'\theta','si':r'\sigma','mu':r'\mu','la':r'\lambda'}
def num(s):
    s=s.replace('^','**')
    return re.sub(r'(?<![\w.])(\d+\.?\d*)(?![\w.])',r"mpf('\1')",s)
def asm(t):
    for k,v in GRK.items(): t=re.sub(re.escape(v)+r'(?![a-zA-Z])',' '+k+' ',t)
    t=re.sub(r'\|([^|]*)\|',r'abs(\1)',t)
    t=t.replace(r'\geq','>=').replace(r'\leq','<=').replace(r'\ge','>=').replace(r'\le','<=').replace(r'\neq','!=').replace(r'\ne','!=').replace(r'\pi','pi').replace('^','**')
    t=re.sub(r'(?<![\w.])(\d+)([a-z])',r'\1*\2',t)
    if '=' in t and not re.search(r'[<>!]=',t): t=t.replace('=','==')
    return t
def letters(*es):
    out=[]
    for e in es:
        for w in re.findall(r'[A-Za-z_]+',e):
            if (w in REALS or w in INTS) and w not in out: out.append(w)
    return out
def I_(f,*l):
    return mp.quad(f,list(l))
def S(f,lo,hi):
    if hi==mp.inf: return mp.nsum(f,[int(lo),mp.inf])
    return mp.fsum(f(mpf(k)) for k in range(int(lo),int(hi)+1))
def P(f,lo,hi):
    if hi==mp.inf: return mp.nprod(f,[int(lo),mp.inf])
    r=mpf(1)
    for k in range(int(lo),int(hi)+1): r*=f(mpf(k))
    return r
def B(n,k):
    return mp.binomial(n,k)
G=dict(vars(MM)); G.update(mpf=mp.mpf,I_=I_,S=S,P=P,Bn=B,ln=mp.log,fac=mp.factorial,abs=abs,arctan=mp.atan,quadosc=mp.quadosc,H=lambda n:mp.harmonic(n))
def ev(s,env):
    g=dict(G); g.update(env); return eval(num(s),g)
def left(s,env):
    if m:=re.match(r'(.*)@(\w+) (.*)$',s):
        f,v,l=m.groups(); code=compile(num(f.strip()),'f','eval')
        lims=[ev(a,env) for a in l.split(',')]
        g=dict(G); g.update(env)
        def F(x): return eval(code,g,{v:x})
        return mp.quad(F,lims,maxdegree=9)
    if m:=re.match(r'(.*?)(##?)(\w+) (.*),(.*)$',s):
        f,o,v,lo,hi=m.groups(); code=compile(num(f.strip()),'f','eval'); g=dict(G); g.update(env)
        F=lambda x: eval(code,g,{v:x})
        return (P if o=='##' else S)(F,ev(lo,env),ev(hi,env))
    return ev(s,env)
def limvals(s,env):
    f,v,p,side=re.match(r'(.*)@(\w+)->(.*?)([+-]?)$',s).groups()
    code=compile(num(f.strip()),'f','eval'); g=dict(G); g.update(env)
    F=lambda x: eval(code,g,{v:x})
    if p in('inf','-inf','INF'):
        sg=-1 if p=='-inf' else 1
        return [[F(sg*mpf(10)**20),F(sg*mpf(10)**40)]]
    p=ev(p,env); r=[]
    for sg in ([1] if side=='+' else [-1] if side=='-' else [1,-1]):
        r.append([F(p+sg*mpf(10)**-10),F(p+sg*mpf(10)**-22)])
    return r
POOL=[mpf(x) for x in('-2.3','-1','-0.6','0','0.3','0.7','1','1.6','2','3.1','0.15','-0.2')]
def points(ls,assume,want):
    rnd=random.Random(5); out=[]; seen=set()
    conds=[compile(num(asm(a).strip()),'a','eval') for a in assume if r'\to' not in a]
    for _ in range(4000):
        env={}
        for l in ls:
            if l in INTS: env[l]=mpf(rnd.randint(-2,7))
            else:
                env[l]=rnd.choice(POOL)
                if l in POS: env[l]=abs(env[l])+mpf('0.05')
        key=tuple(env.values())
        if key in seen: continue
        seen.add(key)
        try:
            if all(eval(c,G,env) for c in conds): out.append(env)
        except ZeroDivisionError: pass
        if len(out)>=want: break
    return out
def real(v):
    if isinstance(v,MM.mpc):
        if abs(v.imag)>mpf(10)**-12*(1+abs(v.real)): raise ValueError('complex')
        v=v.real
    v=mpf(v)
    if mp.isnan(v): raise ValueError('nan')
    return v
TOL=[12]
def close(a,b):
    if mp.isinf(a) or mp.isinf(b): return a==b
    return abs(a-b)<=mpf(10)**-TOL[0]*max(1,abs(b))
def holds(L,R,env):
    """True/False, raises if undefined"""
    if NAME=='limits' and '->' in L:
        vs=limvals(L,env)
        res=[]
        for a,b in vs:
            a,b=real(a),real(b)
            if R=='O': res.append(abs(b)<=10*(abs(a)+1)); continue
            if R=='o': res.append(abs(b)<mpf(10)**-5); continue
            r=real(ev(R,env))
            if mp.isinf(r): res.append(mp.sign(r)*b>20 and mp.sign(r)*b>1.5*mp.sign(r)*a if True else 0)
            else:
                res.append(close(b,r))
        return all(res)
    l=real(left(L,env))
    if R.startswith('~'):
        d=R[1:].strip(); u=mpf(10)**-len(d.split('.')[1])
        return abs(l-mpf(d))<=u/2
    m=re.match(r'(<=|>=|<|>)(.*)',R)
    if m:
        r=real(ev(m.group(2),env)); d=l-r; tol=mpf(10)**-14*max(1,abs(r))
        return {'<=':d<=tol,'>=':d>=-tol,'<':d<-tol,'>':d>tol}[m.group(1)]
    return close(l,real(ev(R,env)))
from mpmath import inf
def main():
    mp.dps=20 if NAME!='limits' else 250
    if NAME=='sums': mp.dps=30
    only=None if len(sys.argv)<3 else set(range(int(sys.argv[2]),10**6))
    rows=[]; bad=0; tot={'R':0,'W':0}; seen={}
    for ln_,line in enumerate(open(f'{HERE}/{NAME}.txt'),1):
        line=line.strip()
        if not line or line.startswith('#'): continue
        f=[x.strip() for x in line.split(';;')]
        if len(f)!=6: print('FIELDS',ln_,line); bad+=1; continue
        kind,src,tex,ass,L,R=f
        ass=[a.strip() for a in ass.split(',,') if a.strip()]
        if (tex,tuple(ass)) in seen: print('DUP',ln_,tex); bad+=1
        seen[tex,tuple(ass)]=1
        tot[kind]+=1; rows.append((kind,src,tex,ass))
        if tex.count('{')!=tex.count('}') or tex.count(r'\left')-tex.count(r'\leftarrow')!=len(re.findall(r'\\right(?!arrow)',tex)): print('BRACES',ln_,tex); bad+=1
        if only and ln_ not in only: continue
        bound=[]
        if m:=re.match(r'(.*)@(\w+)(->| )(.*)$',L): bound=[m.group(2)]
        elif m:=re.match(r'(.*?)##?(\w+) ',L): bound=[m.group(2)]
        bound+=re.findall(r'lambda (\w+)',L+R)
        ls=[l for l in letters(L,R) if l not in bound]
        if bound and '@' in L: ls+=[l for l in letters(L.split('@')[1].split('->')[-1] if '->' in L else L.split('@')[1][len(bound[0]):]) if l not in ls and l!=bound[0]]
        res=[]; err=[]
        TOL[0]=12 if kind=='R' else 4
        for env in points(ls,ass,(5 if ls else 1) if kind=='R' else 6):
            try: res.append((holds(L,R,env),env))
            except Exception as e: err.append((repr(e)[:60],{k:float(v) for k,v in env.items()}))
            if kind=='W' and res and not res[-1][0]: break
        ok=bool(res) and (all(r for r,_ in res) if kind=='R' else any(not r for r,_ in res))
        if not ok or (err and kind=='R'):
            bad+=not ok
            det=''
            for r,env in res:
                if (kind=='R')!=bool(r):
                    try: det=f"L={limvals(L,env) if '->' in L else left(L,env)} R={R}"; det=det[:200]
                    except Exception as e: det=repr(e)
                    det+=str({k:float(v) for k,v in env.items()}); break
            print('BAD' if not ok else 'note',ln_,kind,tex,ass,det,err[:2])
    print(NAME,tot,'bad',bad)
    with open(f'{HERE}/{NAME}.toml','w') as o:
        used=set(re.findall(r'\\[A-Za-z]+|[A-Za-z]'," ".join(r[2] for r in rows)))
        ps=[p for p in REALS if p not in GRK and p not in POS+INTS]+list(GRK.values())
        ps+=POS
        o.write(f'title = "{dict(integrals="Definite integrals", limits="Limits and orders", sums="Sums, products and series")[NAME]} of textbooks"\n[symbols]\nparameters = {[p for p in ps]!r}\n'.replace('\\\\','\\'))
        o.write(f'integers = {INTS!r}\n')
        if POS: o.write(f'positive = {POS!r}\n')
        for i,(k,src,tex,ass) in enumerate(rows,1):
            o.write(f'\n# {src}'+('' if k=='R' else ' (altered: a slip of the pen)')+f'\n[[equation]]\nlabel = "{i}"\nrole = "claim"\ntex = \'\'\'{tex}\'\'\'\n')
            if ass: o.write('assume = ['+', '.join(f"'''{a}'''" for a in ass)+']\n')
            o.write('expect = "%s"\n'%('proved' if k=='R' else 'refuted'))
main()
